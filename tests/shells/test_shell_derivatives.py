"""Value, gradient and Hessian of shells are consistent, at every kind of state."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, ShellMesh, StableNeoHookean, StVK

from ..taylor import gradient_order, value_order
from .sheets import bumpy, equilateral, hinge, hinge_vertices, irregular, rolled, sphere

FloatArray = NDArray[np.float64]
Case = tuple[ElasticEnergy, FloatArray, FloatArray]

THICK = np.random.default_rng(1).uniform(0.05, 0.2, size=80)
BALL = ShellMesh(sphere(1).vertices, sphere(1).triangles, thickness=THICK)
SQUARE = irregular(12, thickness=0.3)
STATES: dict[str, tuple[ShellMesh, FloatArray]] = {
    "small": (BALL, bumpy(BALL, 0.01)),
    "large": (BALL, bumpy(BALL, 0.12)),
    "flat": (SQUARE, 1.1 * SQUARE.vertices.reshape(-1)),
    "rolled": (SQUARE, rolled(SQUARE.vertices, 3.0, 0.4).reshape(-1)),
    "folded": (hinge(0.6), hinge_vertices(2.9).reshape(-1)),
    "folded the other way": (hinge(0.6), hinge_vertices(-2.5).reshape(-1)),
}
MATERIALS = {
    "stvk": StVK(lam=1.3, mu=0.7),
    "snh": StableNeoHookean(lam=np.linspace(0.5, 2.0, 80), mu=np.linspace(1.0, 0.3, 80)),
}


@pytest.fixture(params=STATES, scope="module")
def state(request: pytest.FixtureRequest) -> tuple[ShellMesh, FloatArray]:
    return STATES[request.param]


@pytest.fixture(params=["stvk tangent", "stvk angle", "snh tangent", "snh angle"], scope="module")
def case(request: pytest.FixtureRequest, state: tuple[ShellMesh, FloatArray]) -> Case:
    material, bending = request.param.split()
    mesh, x = state
    made_of = MATERIALS[material]
    if not made_of.uniform:
        made_of = made_of.of_tets(np.arange(len(mesh.triangles)))
    energy = ElasticEnergy(mesh, made_of, bending=bending)
    direction = np.random.default_rng(4).normal(size=x.size)
    return energy, x, 0.02 * direction


def test_value_minus_linear_model_falls_at_order_two(case: Case) -> None:
    assert value_order(*case) == pytest.approx(2, abs=0.1)


def test_gradient_minus_linear_model_falls_at_order_two(case: Case) -> None:
    assert gradient_order(*case) == pytest.approx(2, abs=0.1)


def test_the_assembled_hessian_is_the_matrix_of_the_products(case: Case) -> None:
    energy, x, d = case
    assembled = energy.hessian(x).toarray()
    scale = np.abs(assembled).max()
    np.testing.assert_allclose(energy.hessian_product(x, d), assembled @ d, atol=1e-12 * scale)
    np.testing.assert_allclose(assembled, assembled.T, rtol=0, atol=1e-13 * scale)


@pytest.mark.parametrize("projection", ["clamp", "absolute"])
def test_projected_hessians_are_semidefinite(case: Case, projection: str) -> None:
    energy, x, _ = case
    whole, projected = energy.hessian(x), energy.projected_hessian(x, projection=projection)
    least, largest = np.linalg.eigvalsh(projected.toarray())[[0, -1]]
    assert least >= -1e-10 * largest
    # what projection adds is semidefinite too, for each element and so for the sum
    added = np.linalg.eigvalsh((projected - whole).toarray())
    assert added[0] >= -1e-10 * largest


def test_the_scalar_matrix_is_the_stiffness_of_small_heights_of_a_flat_sheet() -> None:
    """Along z a flat sheet only bends; the scalar matrix adds the membrane's Laplacian."""
    mesh = equilateral(5, 4, thickness=0.1)
    energy = ElasticEnergy(mesh, StVK(lam=1.0, mu=1.0))
    heights = np.random.default_rng(2).normal(size=(len(mesh.vertices), 3)) * [0, 0, 1]
    bending = energy.hessian_product(mesh.vertices, heights).reshape(-1, 3)
    assert np.abs(bending[:, :2]).max() < 1e-14
    # the Laplacian of the membrane, 2 mu + lam' = 8/3
    hats = np.linalg.inv(np.diff(mesh.vertices[mesh.triangles], axis=1)[:, :, :2])
    hats = np.stack([-hats[..., 0], hats[..., 0] - hats[..., 1], hats[..., 1]], axis=2)
    laplacian = np.zeros(len(mesh.vertices))
    for corners, hat, area in zip(mesh.triangles, hats, mesh.areas, strict=True):
        laplacian[corners] += 8 / 3 * 0.1 * area * (hat**2).sum(axis=0)
    bent = energy.hessian(mesh.vertices).diagonal().reshape(-1, 3)[:, 2]
    np.testing.assert_allclose(energy.core.scalar_diagonal(), laplacian + bent, rtol=1e-10)
