"""Energies and forces of meshes compared with independent implementations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray
from skfem.helpers import ddot, eye, grad, mul, trace, transpose

from snapspace import ElasticEnergy, Material, StVK, TetMesh

from ..shapes import deformed, flat_cylinder, irregular_bar
from .densities import formula, has_barrier, with_formula

FloatArray = NDArray[np.float64]
Oracle = Callable[[TetMesh, FloatArray, Material], tuple[float, FloatArray]]
CASES = [
    pytest.param(irregular_bar(), 0.2, id="bar"),
    pytest.param(irregular_bar(), 1.5, id="inverted"),
    pytest.param(flat_cylinder(), 0.1, id="flat"),
]


def by_numpy(mesh: TetMesh, x: FloatArray, material: Material) -> tuple[float, FloatArray]:
    """Energy and force by definition: the SVD of F of each tet, and the formula of psi."""
    corners, moved = mesh.vertices[mesh.tets], x.reshape(-1, 3)[mesh.tets]
    Dm = (corners[:, 1:] - corners[:, :1]).swapaxes(1, 2)
    F = (moved[:, 1:] - moved[:, :1]).swapaxes(1, 2) @ np.linalg.inv(Dm)
    U, s, Vt = np.linalg.svd(F)
    U[:, :, 2] *= np.linalg.det(U)[:, None]
    Vt[:, 2] *= np.linalg.det(Vt)[:, None]
    s[:, 2] *= np.sign(np.linalg.det(F))
    psi, by_stretch = formula(material, s)
    volumes = np.linalg.det(Dm) / 6
    P = U * by_stretch[:, None, :] @ Vt
    pulls = (volumes[:, None, None] * P @ np.linalg.inv(Dm).swapaxes(1, 2)).swapaxes(1, 2)
    gradient = np.zeros_like(mesh.vertices)
    np.add.at(gradient, mesh.tets[:, 1:], pulls)
    np.add.at(gradient, mesh.tets[:, 0], -pulls.sum(axis=1))
    return float(volumes @ psi), gradient.reshape(-1)


def by_scikit_fem(mesh: TetMesh, x: FloatArray, material: Material) -> tuple[float, FloatArray]:
    """The weak form: energy and first variation, integrated over linear vector elements."""
    element = skfem.ElementVector(skfem.ElementTetP1())
    basis = skfem.Basis(skfem.MeshTet(mesh.vertices.T, mesh.tets.T.astype(np.int64)), element)
    places = basis.nodal_dofs.T  # (n, 3): where scikit-fem keeps x, y, z of every vertex
    displacement = np.zeros(basis.N)
    displacement[places] = x.reshape(-1, 3) - mesh.vertices

    def strain_and_gradient(w: skfem.FormExtraParams) -> tuple[FloatArray, FloatArray]:
        identity = eye(np.ones_like(w.x[0]), 3)
        F = grad(w["u"]) + identity
        return (mul(transpose(F), F) - identity) / 2, F

    @skfem.Functional
    def energy(w):  # type: ignore[no-untyped-def]
        E, _ = strain_and_gradient(w)
        return material.mu * ddot(E, E) + material.lam / 2 * trace(E) ** 2

    @skfem.LinearForm
    def variation(v, w):  # type: ignore[no-untyped-def]
        E, F = strain_and_gradient(w)
        S = 2 * material.mu * E + eye(material.lam * trace(E), 3)
        return ddot(mul(F, S), grad(v))

    field = basis.interpolate(displacement)
    return float(energy.assemble(basis, u=field)), variation.assemble(basis, u=field)[
        places
    ].reshape(-1)


def assert_agree(mesh: TetMesh, size: float, material: Material, oracle: Oracle) -> None:
    x = deformed(mesh, size)
    value, gradient = ElasticEnergy(mesh, material).value_and_gradient(x)
    expected, expected_gradient = oracle(mesh, x, material)
    assert value == pytest.approx(expected, rel=1e-10)
    scale = np.abs(expected_gradient).max()
    assert gradient == pytest.approx(expected_gradient, abs=1e-10 * scale)


@pytest.mark.parametrize(("mesh", "size"), CASES)
def test_st_venant_kirchhoff_agrees_with_scikit_fem(mesh: TetMesh, size: float) -> None:
    assert_agree(mesh, size, StVK(lam=1.5, mu=0.7), by_scikit_fem)


@pytest.mark.parametrize(("mesh", "size"), CASES)
@with_formula
def test_energy_and_force_agree_with_numpy(material: Material, mesh: TetMesh, size: float) -> None:
    if has_barrier(material):
        size *= 0.05  # so that no tet is inverted
    assert_agree(mesh, size, material, by_numpy)
