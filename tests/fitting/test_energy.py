"""The energy of fits is symmetric Dirichlet's, in the numbers of the mesh, with its barrier.

Derivatives, invariances and closed forms of the density are tested in tests/energy.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import ElasticEnergy, SymmetricDirichlet, TetMesh
from snapspace import _core as core

from ..shapes import irregular_bar
from ..taylor import observed_order
from .bodies import body, fitting_system

FloatArray = NDArray[np.float64]
RANDOM = np.random.default_rng(8)


@pytest.fixture(scope="module")
def mesh() -> TetMesh:
    return irregular_bar()


@pytest.fixture(scope="module")
def system(mesh: TetMesh) -> core.FittingSystem:
    corners = mesh.tets[:1]
    weights = np.full((1, 4), 0.25)
    return core.FittingSystem(mesh.vertices, mesh.tets, corners, weights, np.ones(1))


def linear_map(mesh: TetMesh, F: FloatArray) -> FloatArray:
    return (mesh.vertices @ F.T - mesh.vertices).reshape(-1)


def some_displacement(mesh: TetMesh) -> FloatArray:
    F = np.array([[1.3, 0.2, 0.0], [0.0, 0.8, 0.1], [-0.2, 0.0, 0.9]])
    return linear_map(mesh, F) + 0.01 * RANDOM.standard_normal(mesh.vertices.size)


def test_it_is_the_material_of_unit_shear_modulus(
    mesh: TetMesh, system: core.FittingSystem
) -> None:
    """Value, gradient, and the Hessian with negative eigenvalues of tets clamped."""
    u, v = some_displacement(mesh), RANDOM.standard_normal(mesh.vertices.size)
    material = ElasticEnergy(mesh, SymmetricDirichlet(mu=1.0))
    x = mesh.vertices.reshape(-1) + u
    value, gradient = system.energy(u)
    expected, force = material.value_and_gradient(x)
    assert value == pytest.approx(expected, rel=1e-12)
    np.testing.assert_allclose(gradient, force, rtol=0, atol=1e-12 * np.abs(force).max())
    product = material.projected_hessian(x, projection="clamp") @ v
    found = system.projected_hessian_product(u, v)
    np.testing.assert_allclose(found, product, rtol=0, atol=1e-12 * np.abs(product).max())


def test_gradient(mesh: TetMesh, system: core.FittingSystem) -> None:
    u, v = some_displacement(mesh), RANDOM.standard_normal(mesh.vertices.size)
    value, gradient = system.energy(u)

    def remainder(step: float) -> float:
        return system.energy(u + 0.1 * step * v)[0] - value - 0.1 * step * float(gradient @ v)

    assert observed_order(remainder) == pytest.approx(2.0, abs=0.1)


def test_hessian_where_nothing_is_projected(mesh: TetMesh, system: core.FittingSystem) -> None:
    """All tets stretched: then every eigenvalue is positive, and the projected one is the true."""
    u = linear_map(mesh, np.diag([1.6, 1.4, 1.5]))
    u += 0.005 * RANDOM.standard_normal(u.size)
    v = RANDOM.standard_normal(u.size)
    gradient, product = system.energy(u)[1], system.projected_hessian_product(u, v)

    def remainder(step: float) -> FloatArray:
        return system.energy(u + 0.1 * step * v)[1] - gradient - 0.1 * step * product

    assert observed_order(remainder) == pytest.approx(2.0, abs=0.1)


def test_projected_hessian_is_semi_definite(mesh: TetMesh, system: core.FittingSystem) -> None:
    u = linear_map(mesh, np.diag([0.5, 0.6, 0.7]))
    H = np.stack([system.projected_hessian_product(u, e) for e in np.eye(u.size)])
    np.testing.assert_allclose(H, H.T, atol=1e-12 * np.abs(H).max())
    assert np.linalg.eigvalsh(H).min() > -1e-12 * np.abs(H).max()


def test_value_of_a_stretch(mesh: TetMesh, system: core.FittingSystem) -> None:
    s = np.array([0.5, 1.1, 1.7])
    expected = mesh.volume * (s**2 + s**-2 - 2).sum() / 4
    assert system.energy(linear_map(mesh, np.diag(s)))[0] == pytest.approx(expected)


def test_it_is_zero_for_rigid_motions_and_the_same_after_them(
    mesh: TetMesh, system: core.FittingSystem
) -> None:
    R = Rotation.from_rotvec([0.4, -1.0, 2.0]).as_matrix()
    value, gradient = system.energy(linear_map(mesh, R) + 3.0)
    assert abs(value) < 1e-13 * mesh.volume
    np.testing.assert_allclose(gradient, 0.0, atol=1e-12)
    u = some_displacement(mesh)
    turned = (mesh.vertices + u.reshape(-1, 3)) @ R.T - mesh.vertices
    assert system.energy(turned.reshape(-1))[0] == pytest.approx(system.energy(u)[0])


def test_at_rest_everything_is_exactly_zero(mesh: TetMesh, system: core.FittingSystem) -> None:
    value, gradient = system.energy(np.zeros(mesh.vertices.size))
    assert value == 0.0
    assert not gradient.any()


def test_it_is_infinite_where_a_tet_is_inverted_or_flat() -> None:
    mesh, surface = body()
    system = fitting_system(mesh, surface)
    for height in (0.0, -1.0):
        assert system.energy(linear_map(mesh, np.diag([1.0, 1.0, height])))[0] == np.inf
    u = np.zeros((len(mesh.vertices), 3))
    u[0] = 10.0
    assert system.energy(u.reshape(-1))[0] == np.inf, "one tet is enough"


def test_it_is_not_finite_where_the_shape_is_not(mesh: TetMesh, system: core.FittingSystem) -> None:
    u = np.zeros(mesh.vertices.size)
    u[5] = np.nan
    assert not np.isfinite(system.energy(u)[0])
