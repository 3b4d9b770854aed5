"""Value, gradient and Hessian of every material are consistent, at every kind of state."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import ElasticEnergy, Material, StVK, TetMesh

from ..shapes import deformed, flat_cylinder, irregular_bar, one_tet
from ..taylor import gradient_order, observed_order, value_order
from .densities import EACH, has_barrier

Case = tuple[ElasticEnergy, np.ndarray, np.ndarray]


def stretched() -> np.ndarray:
    """A bar stretched to twice and compressed to half its sizes, with noise in every tet."""
    F = np.array([[1.9, 0.3, 0.0], [0.0, 0.5, 0.2], [-0.2, 0.0, 1.2]])
    return (deformed(irregular_bar(), 0.03).reshape(-1, 3) @ F.T).reshape(-1)


STATES = {
    "small": (irregular_bar(), deformed(irregular_bar(), 0.02)),
    "large": (irregular_bar(), stretched()),
    "flat": (flat_cylinder(), deformed(flat_cylinder(), 0.003)),
    "tet": (one_tet(), deformed(one_tet(), 0.25)),
    "inverted": (irregular_bar(), deformed(irregular_bar(), 1.5)),
}
CASES = [
    pytest.param((material, name), id=f"{material.kind}-{name}")
    for material in EACH
    for name in STATES
    if name != "inverted" or not has_barrier(material)
]


@pytest.fixture(params=CASES)
def case(request: pytest.FixtureRequest) -> Case:
    material: Material
    material, name = request.param
    mesh, x = STATES[name]
    energy = ElasticEnergy(mesh, material)
    assert (energy.inverted_tets(x) > 0) == (name == "inverted")
    direction = np.random.default_rng(4).normal(size=x.size)
    return energy, x, direction * _length(mesh)


def _length(mesh: TetMesh) -> float:
    """A third of the size of the flattest tet: the scale on which the energy changes."""
    corners = mesh.vertices[mesh.tets]
    return float(np.linalg.svd(corners[:, 1:] - corners[:, :1], compute_uv=False).min() / 3)


def test_value_minus_linear_model_falls_at_order_two(case: Case) -> None:
    assert value_order(*case) == pytest.approx(2, abs=0.1)


def test_value_minus_quadratic_model_falls_at_order_three(case: Case) -> None:
    energy, x, d = case
    value, gradient = energy.value_and_gradient(x)
    curvature = d @ energy.hessian_product(x, d)

    def remainder(h: float) -> float:
        model = value + h * (gradient @ d) + h**2 / 2 * curvature
        return float(energy.value(x + h * d) - model)

    # larger steps: the third order must stand out from the rounding of the value
    assert observed_order(remainder, [0.02, 0.01, 0.005, 0.0025]) == pytest.approx(3, abs=0.1)


def test_gradient_minus_linear_model_falls_at_order_two(case: Case) -> None:
    assert gradient_order(*case) == pytest.approx(2, abs=0.1)


def test_hessian_products_have_symmetric_differences(case: Case) -> None:
    """The third derivative is symmetric in d and v; the remainder falls at order two."""
    energy, x, d = case
    v = np.random.default_rng(8).normal(size=x.size) * np.abs(d).max() / 3
    by_d, by_v = energy.hessian_product(x, d), energy.hessian_product(x, v)

    def remainder(h: float) -> np.ndarray:
        along_d = energy.hessian_product(x + h * d, v) - by_v
        return along_d - (energy.hessian_product(x + h * v, d) - by_d)

    first = np.linalg.norm(energy.hessian_product(x + 1e-2 * d, v) - by_v)
    assert np.linalg.norm(remainder(1e-2)) < 0.5 * first
    assert observed_order(remainder) == pytest.approx(2, abs=0.15)


def test_the_assembled_hessian_is_the_matrix_of_the_products(case: Case) -> None:
    energy, x, _ = case
    assembled = energy.hessian(x).toarray()
    directions = np.random.default_rng(9).normal(size=(5, x.size))
    products = np.array([energy.hessian_product(x, v) for v in directions])
    scale = np.abs(assembled).max()
    np.testing.assert_allclose(products, directions @ assembled, rtol=0, atol=1e-12 * scale)
    np.testing.assert_allclose(assembled, assembled.T, rtol=0, atol=1e-14 * scale)


def test_vertices_that_share_no_tet_have_no_entry_in_the_hessian() -> None:
    mesh = irregular_bar(4, 1, 1)
    hessian = ElasticEnergy(mesh, StVK()).hessian(deformed(mesh, 0.1)).toarray()
    share = np.zeros((len(mesh.vertices),) * 2, dtype=bool)
    for tet in mesh.tets:
        share[np.ix_(tet, tet)] = True
    assert not share.all()
    assert not hessian[~np.repeat(np.repeat(share, 3, 0), 3, 1)].any()
