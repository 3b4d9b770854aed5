from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, StVK, TetMesh

from ..shapes import deformed, flat_cylinder, irregular_bar, random_rotation

LAM, MU = 1.5, 0.7
MATERIAL = StVK(lam=LAM, mu=MU)


@pytest.fixture(params=[irregular_bar(), flat_cylinder()], ids=["bar", "flat"])
def mesh(request: pytest.FixtureRequest) -> TetMesh:
    mesh: TetMesh = request.param
    return mesh


def homogeneous(mesh: TetMesh, F: NDArray[np.float64]) -> float:
    """Energy density of the same deformation gradient everywhere."""
    return ElasticEnergy(mesh, MATERIAL).value(mesh.vertices @ F.T) / mesh.volume


@pytest.mark.parametrize("stretch", [0.0, 0.5, 0.99, 1.3, 3.0, -1.2])
def test_uniaxial_stretch(mesh: TetMesh, stretch: float) -> None:
    """F = diag(s, 1, 1): E = diag(e, 0, 0) with e = (s^2 - 1) / 2, so psi = (mu + lam/2) e^2."""
    e = (stretch**2 - 1) / 2
    density = homogeneous(mesh, np.diag([stretch, 1.0, 1.0]))
    assert density == pytest.approx((MU + LAM / 2) * e**2, rel=1e-11)


@pytest.mark.parametrize("shear", [1e-3, 0.4, 2.0])
def test_simple_shear(mesh: TetMesh, shear: float) -> None:
    """F = I + g e1 e2^T: E_12 = g/2, E_22 = g^2/2, so psi = mu (g^2/2 + g^4/4) + lam g^4/8."""
    F = np.eye(3)
    F[0, 1] = shear
    density = MU * (shear**2 / 2 + shear**4 / 4) + LAM / 8 * shear**4
    assert homogeneous(mesh, F) == pytest.approx(density, rel=1e-8)


@pytest.mark.parametrize("scale", [0.3, 1.7])
def test_uniform_scaling_after_a_turn(mesh: TetMesh, scale: float) -> None:
    e = (scale**2 - 1) / 2
    density = homogeneous(mesh, scale * random_rotation())
    assert density == pytest.approx(3 * MU * e**2 + LAM / 2 * (3 * e) ** 2, rel=1e-10)


def test_along_a_line_the_energy_is_exactly_quartic(mesh: TetMesh) -> None:
    energy = ElasticEnergy(mesh, MATERIAL)
    start = deformed(mesh, 0.3)
    direction = np.random.default_rng(7).normal(size=start.size)
    values = np.array([energy.value(start + t * direction) for t in range(-4, 5)])
    assert np.abs(np.diff(values, 5)).max() < 1e-12 * np.abs(values).max()
    assert np.abs(np.diff(values, 4)).min() > 1e-3 * np.abs(values).max()


@pytest.mark.parametrize("size", [1e-8, 1e-12])
def test_small_displacements_keep_their_precision(mesh: TetMesh, size: float) -> None:
    """E = u^T H u / 2 up to a relative O(u); from F^T F - I it would be off by 1e-16 / u."""
    energy = ElasticEnergy(mesh, MATERIAL)
    u = deformed(mesh, size) - mesh.vertices.reshape(-1)
    value, gradient = energy.core.value_and_gradient(u)
    force = energy.hessian(mesh.vertices) @ u
    allowed = 1e3 * size + 1e-12  # the cubic term: tets are some 40 times thinner than long
    assert value == pytest.approx(u @ force / 2, rel=allowed)
    assert np.linalg.norm(gradient - force) < allowed * np.linalg.norm(force)


@pytest.mark.parametrize("size", [1e-8, 1e-12])
def test_positions_lose_only_the_digits_that_they_do_not_hold(mesh: TetMesh, size: float) -> None:
    energy = ElasticEnergy(mesh, MATERIAL)
    x = deformed(mesh, size)
    u = x - mesh.vertices.reshape(-1)
    assert energy.value(x) == energy.core.value_and_gradient(u)[0]
