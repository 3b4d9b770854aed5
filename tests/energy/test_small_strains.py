"""Near rest every material is linear elasticity with its lam and mu, also per tet."""

from __future__ import annotations

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray
from skfem.helpers import ddot, div, sym_grad

from snapspace import ElasticEnergy, Material, StableNeoHookean, StVK, TetMesh
from snapspace.generators import bar

from ..shapes import deformed, flat_cylinder, irregular_bar
from .densities import every_kind, every_material, varied

FloatArray = NDArray[np.float64]
MESHES = pytest.mark.parametrize("mesh", [bar(2, 2, 2), irregular_bar(), flat_cylinder()], ids=repr)


def linear_elasticity(mesh: TetMesh, lam: FloatArray, mu: FloatArray) -> FloatArray:
    """The dense stiffness matrix by scikit-fem, with moduli per element."""
    element = skfem.ElementVector(skfem.ElementTetP1())
    basis = skfem.Basis(skfem.MeshTet(mesh.vertices.T, mesh.tets.T.astype(np.int64)), element)
    piecewise = basis.with_element(skfem.ElementTetP0())

    @skfem.BilinearForm
    def stiffness(u, v, w):  # type: ignore[no-untyped-def]
        return 2 * w["mu"] * ddot(sym_grad(u), sym_grad(v)) + w["lam"] * div(u) * div(v)

    fields = {"lam": piecewise.interpolate(lam), "mu": piecewise.interpolate(mu)}
    places = basis.nodal_dofs.T.reshape(-1)  # where scikit-fem keeps x, y, z of every vertex
    matrix: FloatArray = stiffness.assemble(basis, **fields).toarray()[np.ix_(places, places)]
    return matrix


@MESHES
@every_kind
def test_the_hessian_at_rest_is_that_of_linear_elasticity(
    kind: type[Material], mesh: TetMesh
) -> None:
    material = varied(kind, len(mesh.tets))
    hessian = ElasticEnergy(mesh, material).hessian(mesh.vertices).toarray()
    lam, mu = (np.broadcast_to(modulus, len(mesh.tets)) for modulus in (material.lam, material.mu))
    expected = linear_elasticity(mesh, lam.copy(), mu.copy())
    np.testing.assert_allclose(hessian, expected, rtol=0, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("mesh", [bar(2, 2, 2), irregular_bar()], ids=repr)
@every_material
def test_the_hessian_at_rest_has_six_zero_modes_and_is_otherwise_positive(
    material: Material, mesh: TetMesh
) -> None:
    hessian = ElasticEnergy(mesh, material).hessian(mesh.vertices).toarray()
    eigenvalues = np.linalg.eigvalsh(hessian)
    noise = 1e-12 * eigenvalues[-1]
    assert np.abs(eigenvalues[:6]).max() < noise
    assert eigenvalues[6] > 1e3 * noise
    about = mesh.vertices - mesh.vertices.mean(axis=0)
    turns = [np.cross(axis, about).reshape(-1) for axis in np.eye(3)]
    shifts = [np.tile(axis, len(about)) for axis in np.eye(3)]
    for mode in turns + shifts:
        assert np.abs(hessian @ mode).max() < noise * np.abs(mode).max()


@pytest.mark.parametrize("mesh", [irregular_bar(), flat_cylinder()], ids=repr)
@every_material
def test_small_displacements_have_the_energy_of_linear_elasticity(
    material: Material, mesh: TetMesh
) -> None:
    """They agree up to the cubic term, which falls with the size, and rounding of stresses of F."""
    energy = ElasticEnergy(mesh, material)
    hessian = energy.hessian(mesh.vertices)
    for size in (1e-5, 1e-6):
        u = deformed(mesh, size) - mesh.vertices.reshape(-1)
        value, gradient = energy.core.value_and_gradient(u)
        force = hessian @ u
        allowed = 1e3 * size + 1e-12 / size  # tets are about 40 times as long as thick
        assert value == pytest.approx(u @ force / 2, rel=allowed)
        assert np.linalg.norm(gradient - force) < allowed * np.linalg.norm(force)


@pytest.mark.parametrize("size", [1e-8, 1e-12])
@pytest.mark.parametrize("mesh", [irregular_bar(), flat_cylinder()], ids=repr)
@pytest.mark.parametrize("kind", [StVK, StableNeoHookean])
def test_densities_of_displacement_gradients_keep_their_precision_near_rest(
    kind: type[Material], mesh: TetMesh, size: float
) -> None:
    """E = u^T H u / 2 up to a relative O(u); with F^T F - I the error would be 1e-16 / u."""
    energy = ElasticEnergy(mesh, kind.from_lame(lam=1.5, mu=0.7))
    u = deformed(mesh, size) - mesh.vertices.reshape(-1)
    value, gradient = energy.core.value_and_gradient(u)
    force = energy.hessian(mesh.vertices) @ u
    allowed = 1e3 * size + 1e-12
    assert value == pytest.approx(u @ force / 2, rel=allowed)
    assert np.linalg.norm(gradient - force) < allowed * np.linalg.norm(force)


@pytest.mark.parametrize("size", [1e-8, 1e-12])
def test_positions_lose_only_the_digits_that_they_cannot_represent(size: float) -> None:
    mesh = irregular_bar()
    energy = ElasticEnergy(mesh, StVK(lam=1.5, mu=0.7))
    x = deformed(mesh, size)
    u = x - mesh.vertices.reshape(-1)
    assert energy.value(x) == energy.core.value_and_gradient(u)[0]
