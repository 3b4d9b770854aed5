"""The energy of fits: the symmetric Dirichlet energy with a bound on the stretch.

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
STRETCH = 10.0


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


def test_without_a_bound_it_is_the_material_of_unit_shear_modulus(
    mesh: TetMesh, system: core.FittingSystem
) -> None:
    """Value, gradient, and the Hessian with the negative eigenvalues of each tet clamped."""
    u, v = some_displacement(mesh), RANDOM.standard_normal(mesh.vertices.size)
    material = ElasticEnergy(mesh, SymmetricDirichlet(mu=1.0))
    x = mesh.vertices.reshape(-1) + u
    value, gradient = system.energy(u, stretch=np.inf)
    expected, force = material.value_and_gradient(x)
    assert value == pytest.approx(expected, rel=1e-12)
    np.testing.assert_allclose(gradient, force, rtol=0, atol=1e-12 * np.abs(force).max())
    product = material.projected_hessian(x, projection="clamp") @ v
    found = system.projected_hessian_product(u, v, stretch=np.inf)
    np.testing.assert_allclose(found, product, rtol=0, atol=1e-12 * np.abs(product).max())


def test_gradient(mesh: TetMesh, system: core.FittingSystem) -> None:
    u, v = some_displacement(mesh), RANDOM.standard_normal(mesh.vertices.size)
    value, gradient = system.energy(u, stretch=STRETCH)

    def remainder(step: float) -> float:
        return (
            system.energy(u + 0.1 * step * v, stretch=STRETCH)[0]
            - value
            - 0.1 * step * float(gradient @ v)
        )

    assert observed_order(remainder) == pytest.approx(2.0, abs=0.1)


def test_hessian_where_nothing_is_projected(mesh: TetMesh, system: core.FittingSystem) -> None:
    """If all tets are stretched, every eigenvalue is positive: the projection changes nothing."""
    u = linear_map(mesh, np.diag([1.6, 1.4, 1.5]))
    u += 0.005 * RANDOM.standard_normal(u.size)
    v = RANDOM.standard_normal(u.size)
    gradient, product = (
        system.energy(u, stretch=STRETCH)[1],
        system.projected_hessian_product(u, v, stretch=STRETCH),
    )

    def remainder(step: float) -> FloatArray:
        return (
            system.energy(u + 0.1 * step * v, stretch=STRETCH)[1] - gradient - 0.1 * step * product
        )

    assert observed_order(remainder) == pytest.approx(2.0, abs=0.1)


def test_projected_hessian_is_semi_definite(mesh: TetMesh, system: core.FittingSystem) -> None:
    u = linear_map(mesh, np.diag([0.5, 0.6, 0.7]))
    H = np.stack([system.projected_hessian_product(u, e, stretch=STRETCH) for e in np.eye(u.size)])
    np.testing.assert_allclose(H, H.T, atol=1e-12 * np.abs(H).max())
    assert np.linalg.eigvalsh(H).min() > -1e-12 * np.abs(H).max()


def test_value_of_a_stretch(mesh: TetMesh, system: core.FittingSystem) -> None:
    s = np.array([0.5, 1.1, 1.7])
    distortion = (s**2 + s**-2 - 2).sum()
    expected = mesh.volume * distortion / (1.0 - distortion / STRETCH**2) / 4
    assert system.energy(linear_map(mesh, np.diag(s)), stretch=STRETCH)[0] == pytest.approx(
        expected
    )


@pytest.mark.parametrize("stretch", [STRETCH, 1.0 / STRETCH])
def test_it_grows_without_limit_towards_the_bound(
    mesh: TetMesh, system: core.FittingSystem, stretch: float
) -> None:
    """The bound is on |F|^2 + |F^-1|^2 - 6, so a single stretch of ten is just beyond it."""

    def energy(s: float) -> float:
        value: float = system.energy(linear_map(mesh, np.diag([s, 1.0, 1.0])), stretch=STRETCH)[0]
        return value

    share = 0.999 if stretch > 1.0 else 1.0 / 0.999
    inside, plain = energy(share * stretch), mesh.volume * STRETCH**2 / 4
    assert 20.0 * plain < inside < np.inf
    assert energy(1.02 * stretch if stretch > 1.0 else stretch / 1.02) == np.inf


def test_it_is_zero_for_rigid_motions_and_the_same_after_them(
    mesh: TetMesh, system: core.FittingSystem
) -> None:
    R = Rotation.from_rotvec([0.4, -1.0, 2.0]).as_matrix()
    value, gradient = system.energy(linear_map(mesh, R) + 3.0, stretch=STRETCH)
    assert abs(value) < 1e-13 * mesh.volume
    np.testing.assert_allclose(gradient, 0.0, atol=1e-12)
    u = some_displacement(mesh)
    turned = (mesh.vertices + u.reshape(-1, 3)) @ R.T - mesh.vertices
    assert system.energy(turned.reshape(-1), stretch=STRETCH)[0] == pytest.approx(
        system.energy(u, stretch=STRETCH)[0]
    )


def test_at_rest_everything_is_exactly_zero(mesh: TetMesh, system: core.FittingSystem) -> None:
    value, gradient = system.energy(np.zeros(mesh.vertices.size), stretch=STRETCH)
    assert value == 0.0
    assert not gradient.any()


def test_it_is_infinite_where_a_tet_is_inverted_or_flat() -> None:
    mesh, surface = body()
    system = fitting_system(mesh, surface)
    for height in (0.0, -1.0):
        assert (
            system.energy(linear_map(mesh, np.diag([1.0, 1.0, height])), stretch=STRETCH)[0]
            == np.inf
        )
    u = np.zeros((len(mesh.vertices), 3))
    u[0] = 10.0
    assert system.energy(u.reshape(-1), stretch=STRETCH)[0] == np.inf, "one tet is enough"


def test_it_is_not_finite_where_the_shape_is_not(mesh: TetMesh, system: core.FittingSystem) -> None:
    u = np.zeros(mesh.vertices.size)
    u[5] = np.nan
    assert not np.isfinite(system.energy(u, stretch=STRETCH)[0])
