"""The minimisers of the live loop, on objectives whose minimisers are known."""

from __future__ import annotations

import gc
import math
import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ReducedModel
from snapspace import _core as core
from snapspace.reduction import coefficient_count

from .loops import TIGHT, pulled, scaled

FloatArray = NDArray[np.float64]


@pytest.fixture(params=["newton", "bfgs"])
def method(request: pytest.FixtureRequest) -> core.Method:
    return getattr(core.Method, request.param)


def spd(dimension: int, condition: float, seed: int = 0) -> FloatArray:
    """A random symmetric positive definite matrix with eigenvalues from 1 to `condition`."""
    Q = np.linalg.qr(np.random.default_rng(seed).normal(size=(dimension, dimension)))[0]
    A = Q @ np.diag(np.geomspace(1, condition, dimension)) @ Q.T
    return np.ascontiguousarray((A + A.T) / 2)


def fourth_powers(weights: FloatArray) -> FloatArray:
    """Coefficients of sum_i weights_i q_i^4; q_i^4 is the last monomial of each variable."""
    coefficients = np.zeros(coefficient_count(len(weights)))
    for i, weight in enumerate(weights):
        coefficients[coefficient_count(i + 1) - 1] = weight
    return coefficients


@pytest.mark.parametrize("condition", [1.0, 1e3, 1e8])
def test_a_quadratic_is_solved_in_one_step(condition: float, method: core.Method) -> None:
    """The first approximation, the inverse Hessian at rest, is right everywhere."""
    K, force = spd(12, condition), np.random.default_rng(1).normal(size=12)
    loop = pulled(K, force)
    report = loop.solve(method=method, **{**TIGHT, "tolerance": 1e-10})
    assert report.status == core.Status.converged
    assert report.iterations <= 2
    minimiser = np.linalg.solve(K, force)
    assert loop.q == pytest.approx(minimiser, abs=1e-14 * condition * np.abs(minimiser).max())
    assert report.value == pytest.approx(-force @ minimiser, rel=1e-9)


@pytest.mark.parametrize("start", [0.0, 3.0])
def test_a_convex_quartic_reaches_its_minimiser(start: float, method: core.Method) -> None:
    """Separable: c q^4 + k q^2 - 2 f q, whose derivative has one real root."""
    rng = np.random.default_rng(2)
    c, k, f = rng.uniform(0.1, 5, 10), rng.uniform(0.1, 5, 10), rng.normal(size=10, scale=5)
    loop = pulled(np.diag(k), f, fourth_powers(c))
    loop.q = np.full(10, start)
    report = loop.solve(method=method, **TIGHT)
    roots = [np.roots([4 * ci, 0, 2 * ki, -2 * fi]) for ci, ki, fi in zip(c, k, f, strict=True)]
    minimiser = [float(r[np.abs(r.imag).argmin()].real) for r in roots]
    assert report.status == core.Status.converged
    assert loop.q == pytest.approx(minimiser, abs=1e-6)
    value, gradient = loop.value_and_gradient(loop.q)
    assert report.value == pytest.approx(value, rel=1e-14)
    assert report.gradient_norm == pytest.approx(np.linalg.norm(gradient), rel=1e-12)
    assert report.gradient_norm < 1e-4


def test_a_solve_descends_from_the_hill_of_a_double_well(method: core.Method) -> None:
    """q^4 - 4 q^3 + 2 q^2: a well at rest, a hill, and a deeper well."""
    coefficients = np.array([0.0, 0.0, 0.0, -4.0, 1.0])
    loop = pulled(np.array([[2.0]]), np.zeros(1), coefficients)
    loop.q = np.array([0.9])  # 12 q^2 - 24 q + 4 < 0
    before = loop.value_and_gradient(loop.q)
    assert loop.hessian(loop.q)[0, 0] < 0 and before[1][0] != 0
    report = loop.solve(method=method, **TIGHT)
    assert report.status == core.Status.converged
    assert report.value < before[0]
    assert loop.hessian(loop.q)[0, 0] > 0
    assert abs(loop.value_and_gradient(loop.q)[1][0]) < 1e-6


@pytest.fixture
def loop(posing_model: ReducedModel) -> Any:
    handles = posing_model.handles
    return core.PosingLoop(posing_model.elastic.coefficients, handles.K, handles.L, handles.S)


@pytest.mark.parametrize("seed", range(5))
def test_the_objective_never_grows_from_any_start(
    posing_model: ReducedModel, loop: Any, seed: int, method: core.Method
) -> None:
    rng = np.random.default_rng(seed)
    half_widths = posing_model.problem.domain.half_widths
    loop.set_offsets(posing_model.problem.offsets(rng.uniform(-half_widths, half_widths)))
    loop.q = rng.normal(size=20)
    value = loop.value_and_gradient(loop.q)[0]
    for _ in range(40):
        report = loop.solve(method=method, **scaled(posing_model, max_iterations=1))
        assert report.iterations <= 1
        assert report.value <= value
        assert loop.value_and_gradient(loop.q)[0] == pytest.approx(report.value, rel=1e-13)
        value = report.value


def test_the_termination_tests_hold_at_the_result(
    posing_model: ReducedModel, loop: Any, method: core.Method
) -> None:
    """|grad F| < cbrt(eps) (1 + |F|), in units of the model's scales (paper, sec. 6.2)."""
    half_widths = posing_model.problem.domain.half_widths
    loop.set_offsets(posing_model.problem.offsets(0.7 * half_widths))
    previous = math.inf
    for tolerance in (1e-4, 1e-7, 1e-12):
        loop.q = np.zeros(20)
        report = loop.solve(method=method, **scaled(posing_model, tolerance=tolerance))
        assert report.status == core.Status.converged
        gradient = loop.value_and_gradient(loop.q)[1]
        scale = posing_model.value_scale / posing_model.coordinate_scale
        bound = np.cbrt(tolerance) * (1 + report.value / posing_model.value_scale)
        assert np.linalg.norm(gradient) / scale < bound
        assert report.value <= previous
        previous = report.value


def test_a_tiny_budget_is_reported(
    posing_model: ReducedModel, loop: Any, method: core.Method
) -> None:
    loop.set_offsets(posing_model.problem.offsets(0.7 * posing_model.problem.domain.half_widths))
    report = loop.solve(method=method, **scaled(posing_model, max_iterations=2))
    assert report.status == core.Status.max_iterations
    assert report.iterations == 2
    assert report.evaluations >= 3


def test_a_tolerance_below_rounding_ends_at_the_minimiser_anyway(
    posing_model: ReducedModel, loop: Any, method: core.Method
) -> None:
    loop.set_offsets(posing_model.problem.offsets(0.7 * posing_model.problem.domain.half_widths))
    reference = loop.solve(method=method, **scaled(posing_model, tolerance=1e-12)).value
    loop.q = np.zeros(20)
    report = loop.solve(method=method, **scaled(posing_model, tolerance=1e-200))
    assert report.status in (
        core.Status.line_search_failed,
        core.Status.max_iterations,
        core.Status.max_evaluations,
    )
    assert report.value == pytest.approx(reference, rel=1e-12)


@pytest.mark.parametrize("bad", [1e100, math.inf, math.nan])
def test_a_start_that_is_not_finite_is_reported_and_left_alone(
    loop: Any, bad: float, method: core.Method
) -> None:
    start = np.zeros(20)
    start[3] = bad
    loop.q = start
    report = loop.solve(method=method, **TIGHT)
    assert report.status == core.Status.not_finite
    assert (report.iterations, report.evaluations) == (0, 1)
    assert np.array_equal(loop.q, start, equal_nan=True)


@pytest.mark.parametrize("bad", [math.inf, math.nan])
def test_offsets_that_are_not_finite_are_reported(
    loop: Any, bad: float, method: core.Method
) -> None:
    loop.set_offsets(np.full((3, 3, 4), bad))
    assert loop.solve(method=method, **TIGHT).status == core.Status.not_finite
    assert not loop.q.any()


def test_the_hessian_is_that_of_the_quartic_and_the_handles(
    posing_model: ReducedModel, loop: Any
) -> None:
    q = np.random.default_rng(3).normal(size=20)
    expected = posing_model.elastic.hessian(q) + 2 * posing_model.handles.K
    assert loop.hessian(q) == pytest.approx(expected, rel=1e-13)
    offsets = posing_model.problem.offsets(0.5 * posing_model.problem.domain.half_widths)
    loop.set_offsets(offsets)
    assert loop.value_and_gradient(q)[0] == pytest.approx(posing_model.value(q, offsets), rel=1e-13)


def test_arrays_are_kept_alive_whatever_their_layout(method: core.Method) -> None:
    """The loop points into its arrays, or into the copies that a conversion made."""
    K, force = spd(12, 10.0), np.random.default_rng(1).normal(size=12)
    L = np.zeros((1, 12, 12))
    L[0, :, 0] = force
    loop = core.PosingLoop(
        np.zeros(2 * coefficient_count(12))[::2],
        np.asfortranarray(K.copy()),
        np.asfortranarray(L),
        np.zeros((1, 4, 4)),
    )
    del L
    gc.collect()
    _junk = [np.full((12, 12), 7.0) for _ in range(100)]
    loop.set_offsets(np.eye(1, 12).reshape(1, 3, 4))
    loop.solve(method=method, **TIGHT)
    assert loop.q == pytest.approx(np.linalg.solve(K, force), rel=1e-9)


def arrays(d: int = 3, h: int = 2) -> dict[str, FloatArray]:
    return {
        "coefficients": np.zeros(coefficient_count(d)),
        "K": np.eye(d),
        "L": np.zeros((h, d, 12)),
        "S": np.zeros((h, 4, 4)),
    }


@pytest.mark.parametrize(
    "wrong",
    [
        {"coefficients": np.zeros(34)},
        {"K": np.eye(3, 4)},
        {"K": np.eye(4)},
        {"L": np.zeros((2, 4, 12))},
        {"L": np.zeros((2, 3, 16))},
        {"S": np.zeros((1, 4, 4))},
        {"S": np.zeros((2, 3, 4))},
    ],
)
def test_arrays_that_do_not_match_are_refused(wrong: dict[str, FloatArray]) -> None:
    core.PosingLoop(**arrays())
    with pytest.raises(ValueError, match=re.escape("K (d,d), L (h,d,12), S (h,4,4) do not match")):
        core.PosingLoop(**{**arrays(), **wrong})


@pytest.mark.parametrize("eigenvalue", [0.0, -1.0, math.nan])
def test_handles_that_do_not_hold_the_shape_are_refused(eigenvalue: float) -> None:
    K = np.diag([1.0, eigenvalue, 1.0])
    with pytest.raises(ValueError, match="the reduced Hessian at rest is not positive definite"):
        core.PosingLoop(**{**arrays(), "K": K})


def test_coordinates_and_offsets_of_the_wrong_size_are_refused() -> None:
    loop = core.PosingLoop(**arrays())
    for call in (loop.value_and_gradient, loop.hessian):
        with pytest.raises(ValueError, match="q must have one entry per dimension"):
            call(np.zeros(4))
    with pytest.raises(ValueError, match="q must have one entry per dimension"):
        loop.q = np.zeros(2)
    for shape in ((3, 3, 4), (2, 4, 4), (2, 3, 3)):
        with pytest.raises(ValueError, match=re.escape("offsets must be (handles, 3, 4)")):
            loop.set_offsets(np.zeros(shape))


@pytest.mark.parametrize("method", [core.Method.bfgs, core.Method.newton])
def test_a_solve_descends_from_a_mean_shape_that_is_a_saddle(method: core.Method) -> None:
    """Far poses: q/10 - q^2 + q^4 + 100 p^2 is concave along q and has its minimum there."""
    order = [
        (i, j, k, m)
        for m in range(3)
        for k in range(m + 1)
        for j in range(k + 1)
        for i in range(j + 1)
    ]
    terms = {(0, 0, 0, 1): 0.1, (0, 0, 1, 1): -1.0, (1, 1, 1, 1): 1.0, (0, 0, 2, 2): 100.0}
    loop = core.BlendingLoop(2, np.array([[terms.get(term, 0.0) for term in order]]))
    loop.set_weights(np.ones(1))
    report = loop.solve(
        method=method,
        tolerance=1e-12,
        max_iterations=50,
        max_evaluations=100,
        value_scale=1.0,
        coordinate_scale=1.0,
    )
    assert report.status == core.Status.converged
    lowest = min(np.roots([4.0, 0.0, -2.0, 0.1]).real)
    assert loop.q == pytest.approx([lowest, 0.0], abs=1e-5)


def test_a_mean_shape_without_a_finite_hessian_is_refused() -> None:
    with pytest.raises(
        ValueError, match="the reduced Hessian at the mean shape is far from positive"
    ):
        core.BlendingLoop(1, np.array([[0.0, 0.1, math.nan, 0.0, 1.0]]))
