"""The St.VK energy and force against two independent implementations."""

from __future__ import annotations

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray
from skfem.helpers import ddot, eye, grad, mul, trace, transpose

from snapspace import ElasticEnergy, StVK, TetMesh

from ..shapes import deformed, flat_cylinder, irregular_bar

FloatArray = NDArray[np.float64]
MATERIAL = StVK(lam=1.5, mu=0.7)
CASES = [
    pytest.param(irregular_bar(), 0.2, id="bar"),
    pytest.param(irregular_bar(), 1.5, id="inverted"),
    pytest.param(flat_cylinder(), 0.1, id="flat"),
]


def by_numpy(mesh: TetMesh, x: FloatArray) -> tuple[float, FloatArray]:
    """Straight from the definitions, tet by tet."""
    value, gradient = 0.0, np.zeros_like(mesh.vertices)
    for tet in mesh.tets:
        rest, now = mesh.vertices[tet], x.reshape(-1, 3)[tet]
        Dm = (rest[1:] - rest[0]).T
        F = (now[1:] - now[0]).T @ np.linalg.inv(Dm)
        E = (F.T @ F - np.eye(3)) / 2
        volume = np.linalg.det(Dm) / 6
        value += volume * (MATERIAL.mu * (E * E).sum() + MATERIAL.lam / 2 * np.trace(E) ** 2)
        P = F @ (2 * MATERIAL.mu * E + MATERIAL.lam * np.trace(E) * np.eye(3))
        pull = (volume * P @ np.linalg.inv(Dm).T).T
        gradient[tet[1:]] += pull
        gradient[tet[0]] -= pull.sum(axis=0)
    return value, gradient.reshape(-1)


def by_scikit_fem(mesh: TetMesh, x: FloatArray) -> tuple[float, FloatArray]:
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
        return MATERIAL.mu * ddot(E, E) + MATERIAL.lam / 2 * trace(E) ** 2

    @skfem.LinearForm
    def variation(v, w):  # type: ignore[no-untyped-def]
        E, F = strain_and_gradient(w)
        S = 2 * MATERIAL.mu * E + eye(MATERIAL.lam * trace(E), 3)
        return ddot(mul(F, S), grad(v))

    field = basis.interpolate(displacement)
    return float(energy.assemble(basis, u=field)), variation.assemble(basis, u=field)[
        places
    ].reshape(-1)


@pytest.mark.parametrize("oracle", [by_numpy, by_scikit_fem])
@pytest.mark.parametrize(("mesh", "size"), CASES)
def test_energy_and_force_agree_with(oracle, mesh: TetMesh, size: float) -> None:  # type: ignore[no-untyped-def]
    x = deformed(mesh, size)
    value, gradient = ElasticEnergy(mesh, MATERIAL).value_and_gradient(x)
    expected, expected_gradient = oracle(mesh, x)
    assert value == pytest.approx(expected, rel=1e-11)
    scale = np.abs(expected_gradient).max()
    assert gradient == pytest.approx(expected_gradient, abs=1e-11 * scale)
