"""The sum over few tets: compared with the exact quartic, derivatives, bad input."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import AffineSubspace, Cubature, PosingModel, PosingProblem, StVK
from snapspace.cubature.displacement_gradients import displacement_gradients
from snapspace.reduction import reduced_quartic

from ..shapes import bar_problem, random_rotation, random_subspace
from ..taylor import observed_order

FloatArray = NDArray[np.float64]


def problem_and_subspace(dimension: int) -> tuple[PosingProblem, AffineSubspace]:
    problem = bar_problem()
    return problem, random_subspace(problem.mesh, dimension)


def cubature(dimension: int, tets: int, seed: int = 0) -> Cubature:
    """Some tets with some weights."""
    problem, subspace = problem_and_subspace(dimension)
    rng = np.random.default_rng(seed)
    chosen = np.sort(rng.permutation(len(problem.mesh.tets))[:tets]).astype(np.int32)
    return Cubature.of_tets(problem, subspace, chosen, rng.uniform(0.1, 2.0, tets))


@pytest.mark.parametrize("dimension", [1, 2, 7, 20])
@pytest.mark.parametrize("size", [1e-3, 0.3, 10.0])
def test_all_tets_with_their_volumes_are_the_exact_energy(dimension: int, size: float) -> None:
    problem, subspace = problem_and_subspace(dimension)
    mesh = problem.mesh
    every = np.arange(len(mesh.tets), dtype=np.int32)
    elastic = Cubature.of_tets(problem, subspace, every, np.array(mesh.volumes))
    exact = reduced_quartic(problem.energy, subspace, threads=1)
    q = size * np.random.default_rng(1).normal(size=dimension)
    value, gradient = exact.value_and_gradient(q)
    found, slope = elastic.value_and_gradient(q)
    assert found == pytest.approx(value, rel=2e-6)
    assert slope == pytest.approx(gradient, rel=1e-5, abs=2e-6 * np.abs(gradient).max())
    hessian = exact.hessian(q)
    assert elastic.hessian(q) == pytest.approx(hessian, abs=3e-6 * np.abs(hessian).max())
    assert elastic.rough_hessian(q) == pytest.approx(hessian, abs=3e-6 * np.abs(hessian).max())


@pytest.mark.parametrize(("dimension", "tets"), [(1, 1), (6, 5), (9, 64), (12, 33)])
def test_taylor(dimension: int, tets: int) -> None:
    assert_derivatives(cubature(dimension, tets), seed=2)


def assert_derivatives(elastic: Cubature, *, seed: int) -> None:
    """Gradient and Hessian at a random point leave errors of second order."""
    rng = np.random.default_rng(seed)
    q, direction = rng.normal(size=elastic.dimension), rng.normal(size=elastic.dimension)
    value, gradient = elastic.value_and_gradient(q)
    hessian = elastic.hessian(q)
    assert np.linalg.norm(gradient) > 0
    np.testing.assert_array_equal(hessian, hessian.T)

    def first(t: float) -> float:
        return abs(elastic.value(q + t * direction) - value - t * gradient @ direction)

    def second(t: float) -> float:
        change = elastic.value_and_gradient(q + t * direction)[1] - gradient
        return float(np.linalg.norm(change - t * hessian @ direction))

    assert observed_order(first) == pytest.approx(2, abs=0.1)
    assert observed_order(second) == pytest.approx(2, abs=0.1)


def test_rest_has_no_energy_and_no_force() -> None:
    value, gradient = cubature(8, 20).value_and_gradient(np.zeros(8))
    assert value == 0
    np.testing.assert_array_equal(gradient, np.zeros(8))


def test_translations_and_rotations_cost_nothing() -> None:
    problem, subspace = problem_and_subspace(6)
    vertices = problem.mesh.vertices
    turned = vertices @ random_rotation().T - vertices
    shift = np.tile([1.0, -2.0, 0.5], len(vertices))
    basis = np.column_stack([turned.reshape(-1), shift, subspace.basis])
    wide = AffineSubspace(subspace.tau, basis, subspace.mass, np.ones(8))
    tets = np.arange(0, len(problem.mesh.tets), 3, dtype=np.int32)
    elastic = Cubature.of_tets(problem, wide, tets, np.ones(len(tets)))
    scale = elastic.value(np.eye(8)[2])
    for shifted in (0.0, 3.0, -100.0):
        # rows are rounded, and a rotation's strain is a difference of ones
        assert elastic.value([1.0, shifted, *np.zeros(6)]) < 1e-9 * scale
    q = np.array([0.0, 0.0, 0.3, -0.2, 0.1, 0.5, 0.2, -0.4])
    assert elastic.value(q + 5 * np.eye(8)[1]) == pytest.approx(elastic.value(q), rel=1e-4)


def test_energy_is_never_negative_and_grows_with_the_weights() -> None:
    elastic = cubature(10, 40)
    double = Cubature(elastic.tets, 2 * elastic.weights, elastic.rows, elastic.material)
    for seed in range(20):
        q = np.random.default_rng(seed).normal(size=10) * 10.0 ** (seed % 5 - 2)
        assert elastic.value(q) > 0
        assert double.value(q) == pytest.approx(2 * elastic.value(q), rel=1e-14)


@pytest.mark.parametrize("leading", [1, 2, 5, 8, 9])
def test_leading_is_the_energy_on_the_first_coordinates(leading: int) -> None:
    elastic = cubature(9, 30)
    q = np.random.default_rng(3).normal(size=leading)
    padded = np.append(q, np.zeros(9 - leading))
    value, gradient = elastic.value_and_gradient(padded)
    found, slope = elastic.leading(leading).value_and_gradient(q)
    assert found == pytest.approx(value, rel=1e-5)
    assert slope == pytest.approx(gradient[:leading], rel=1e-4, abs=1e-5 * np.abs(gradient).max())


def test_rows_are_the_displacement_gradients_of_linear_fields() -> None:
    mesh = bar_problem().mesh
    slopes = np.random.default_rng(4).normal(size=(3, 3, 3))
    fields = [(mesh.vertices @ slope.T).reshape(-1) for slope in slopes]
    tets = np.array([0, 7, 30], np.int32)
    rows = displacement_gradients(mesh, np.column_stack(fields), tets)
    for row in rows:
        assert row.T.reshape(3, 3, 3) == pytest.approx(slopes, rel=1e-5, abs=1e-6)


def test_a_coordinate_that_is_not_finite_gives_no_finite_value() -> None:
    elastic = cubature(4, 10)
    for bad in (np.nan, np.inf):
        assert not np.isfinite(elastic.value([0.1, bad, 0.0, 0.0]))


def test_bad_input_is_named() -> None:
    good = cubature(4, 10)
    material = StVK()
    with pytest.raises(ValueError, match=r"10 tets need weights \(10,\)"):
        Cubature(good.tets, good.weights[:9], good.rows, material)
    with pytest.raises(ValueError, match="rows"):
        Cubature(good.tets, good.weights, good.rows[:, :8], material)
    for bad in (0.0, -1.0, np.nan, np.inf):
        weights = good.weights.copy()
        weights[3] = bad
        with pytest.raises(ValueError, match=f"weight of tet {good.tets[3]} is"):
            Cubature(good.tets, weights, good.rows, material)
    problem, subspace = problem_and_subspace(3)
    last = len(problem.mesh.tets)
    with pytest.raises(ValueError, match=f"between 0 and {last - 1}"):
        Cubature.of_tets(problem, subspace, np.array([0, last], np.int32), np.ones(2))


def test_a_model_takes_either_energy(posing_model: PosingModel) -> None:
    mesh = posing_model.problem.mesh
    every = np.arange(len(mesh.tets), dtype=np.int32)
    elastic = Cubature.of_tets(
        posing_model.problem, posing_model.subspace, every, np.array(mesh.volumes)
    )
    assert elastic.dimension == posing_model.dimension
