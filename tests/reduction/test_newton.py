"""Newton's method leaves saddles and saves evaluations; a solve has bounds on its work."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from snapspace import ReducedModel
from snapspace import _core as core
from snapspace.reduction import coefficient_count

from .loops import TIGHT, pulled, scaled


@pytest.fixture
def loop(posing_model: ReducedModel) -> Any:
    handles = posing_model.handles
    return core.PosingLoop(posing_model.elastic.coefficients, handles.K, handles.L, handles.S)


def test_newton_leaves_a_saddle() -> None:
    """The objective is q1^2 (1 - q2) + q1^4 + (q2 - 2)^2 without its constant. From q1 = 0 the
    path leads to (0, 2), where the gradient is zero and the curvature along q1 is negative.
    """
    coefficients = np.zeros(coefficient_count(2))
    coefficients[[4, 7]] = 1.0, -1.0  # q1^4 and q1^2 q2
    loop = pulled(np.eye(2), np.array([0.0, 2.0]), coefficients)
    saddle = np.array([0.0, 2.0])
    assert not loop.value_and_gradient(saddle)[1].any()
    assert loop.hessian(saddle)[0, 0] < 0 < loop.hessian(saddle)[1, 1]
    for start in (np.zeros(2), saddle):
        loop.q = start
        report = loop.solve(method=core.Method.newton, **TIGHT)
        assert report.status == core.Status.converged
        assert np.abs(loop.q) == pytest.approx([np.sqrt(2 / 3), 7 / 3], abs=1e-6)


@pytest.mark.parametrize("method", [core.Method.newton, core.Method.bfgs])
@pytest.mark.parametrize("bound", [1, 2, 3])
def test_evaluations_are_bounded(
    posing_model: ReducedModel, loop: Any, method: core.Method, bound: int
) -> None:
    loop.set_offsets(posing_model.problem.offsets(posing_model.problem.domain.half_widths))
    value = loop.value_and_gradient(loop.q)[0]
    options = scaled(posing_model, max_evaluations=bound, tolerance=1e-12)
    report = loop.solve(method=method, **options)
    assert report.status == core.Status.max_evaluations
    assert report.evaluations <= bound
    assert report.value <= value


def test_newton_and_bfgs_end_in_the_same_place(posing_model: ReducedModel, loop: Any) -> None:
    half_widths = posing_model.problem.domain.half_widths
    rng = np.random.default_rng(5)
    for _ in range(5):
        loop.set_offsets(posing_model.problem.offsets(0.7 * rng.uniform(-half_widths, half_widths)))
        ends = []
        for method in (core.Method.newton, core.Method.bfgs):
            loop.q = np.zeros(20)
            report = loop.solve(method=method, **scaled(posing_model, tolerance=1e-13))
            assert report.status == core.Status.converged
            ends.append((loop.q, report.evaluations))
        assert ends[0][0] == pytest.approx(ends[1][0], abs=1e-5 * posing_model.coordinate_scale)
        assert ends[0][1] < ends[1][1], "second derivatives save evaluations"


@pytest.mark.parametrize("method", [core.Method.newton, core.Method.bfgs])
def test_a_loop_takes_coefficients_in_single_precision(
    posing_model: ReducedModel, method: core.Method
) -> None:
    handles = posing_model.handles
    ends = []
    for single in (True, False):
        loop = core.PosingLoop(
            posing_model.elastic.coefficients, handles.K, handles.L, handles.S, single=single
        )
        loop.set_offsets(posing_model.problem.offsets(posing_model.problem.domain.half_widths))
        assert loop.solve(method=method, **scaled(posing_model)).status == core.Status.converged
        ends.append(loop.q)
    assert ends[0] == pytest.approx(ends[1], abs=1e-4 * posing_model.coordinate_scale)
    assert not np.array_equal(*ends)
