from __future__ import annotations

import numpy as np
import pytest

from snapspace import ElasticEnergy, StVK, TetMesh

from ..shapes import deformed, flat_cylinder, irregular_bar, one_tet
from ..taylor import observed_order

CASES = [
    (irregular_bar(), StVK(lam=1.5, mu=0.7), 0.3),
    (irregular_bar(), StVK(lam=0.0, mu=2.0), 1.5),  # so far that tets are inverted
    (flat_cylinder(), StVK(lam=40.0, mu=1.0), 0.05),
    (one_tet(), StVK(), 0.5),
]


@pytest.fixture(params=CASES, ids=["bar", "inverted", "flat", "tet"])
def case(request: pytest.FixtureRequest) -> tuple[ElasticEnergy, np.ndarray, np.ndarray]:
    mesh, material, size = request.param
    direction = np.random.default_rng(4).normal(size=mesh.vertices.size)
    return ElasticEnergy(mesh, material), deformed(mesh, size), direction * _length(mesh)


def _length(mesh: TetMesh) -> float:
    """Height of the flattest tet: the scale on which the energy changes."""
    return float(mesh.volumes.min() ** (1 / 3) / 4)


def test_value_minus_linear_model_falls_at_order_two(case) -> None:  # type: ignore[no-untyped-def]
    energy, x, d = case
    value, gradient = energy.value_and_gradient(x)
    assert np.linalg.norm(gradient) > 0
    order = observed_order(lambda h: energy.value(x + h * d) - value - h * (gradient @ d))
    assert order == pytest.approx(2, abs=0.1)


def test_value_minus_quadratic_model_falls_at_order_three(case) -> None:  # type: ignore[no-untyped-def]
    energy, x, d = case
    value, gradient = energy.value_and_gradient(x)
    curvature = d @ energy.hessian_product(x, d)

    def remainder(h: float) -> float:
        model = value + h * (gradient @ d) + h**2 / 2 * curvature
        return float(energy.value(x + h * d) - model)

    # larger steps: the third order must stand out from the rounding of the value
    assert observed_order(remainder, [0.04, 0.02, 0.01, 0.005]) == pytest.approx(3, abs=0.1)


def test_gradient_minus_linear_model_falls_at_order_two(case) -> None:  # type: ignore[no-untyped-def]
    energy, x, d = case
    gradient = energy.value_and_gradient(x)[1]
    product = energy.hessian_product(x, d)
    assert np.linalg.norm(product) > 0
    order = observed_order(
        lambda h: energy.value_and_gradient(x + h * d)[1] - gradient - h * product
    )
    assert order == pytest.approx(2, abs=0.1)


def test_the_assembled_hessian_is_the_matrix_of_the_products(case) -> None:  # type: ignore[no-untyped-def]
    energy, x, _ = case
    assembled = energy.hessian(x).toarray()
    columns = [energy.hessian_product(x, axis) for axis in np.eye(x.size)]
    scale = np.abs(assembled).max()
    assert assembled == pytest.approx(np.array(columns).T, abs=1e-13 * scale)
    assert assembled == pytest.approx(assembled.T, abs=1e-14 * scale)


def test_vertices_that_share_no_tet_do_not_meet_in_the_hessian() -> None:
    mesh = irregular_bar(4, 1, 1)
    hessian = ElasticEnergy(mesh, StVK()).hessian(deformed(mesh, 0.1)).toarray()
    share = np.zeros((len(mesh.vertices),) * 2, dtype=bool)
    for tet in mesh.tets:
        share[np.ix_(tet, tet)] = True
    assert not share.all()
    assert not hessian[~np.repeat(np.repeat(share, 3, 0), 3, 1)].any()
