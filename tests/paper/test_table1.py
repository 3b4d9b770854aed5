"""Table 1: what its parts measure, and the faults that it reports."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import paper.cached
import snapspace as ss
from paper.cached import timed_training, training
from paper.live import LEG, drag
from paper.newton import newton_samples
from paper.table1_orderings import times_in_order

from ..shapes import bar_problem

PROBLEM = bar_problem()
SAMPLES = 8


@pytest.fixture(scope="module")
def snapshots() -> ss.Snapshots:
    parameters = ss.sample(PROBLEM.domain, SAMPLES, method="sobol")
    return ss.solve_snapshots(PROBLEM, parameters, options=ss.SolverOptions(tolerance=1e-9))


def test_timed_samples_are_those_of_other_programs(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(paper.cached, "FOLDER", tmp_path)
    solved, seconds = timed_training(PROBLEM, 2)
    assert seconds > 0
    monkeypatch.setattr(ss, "solve_snapshots", None)  # nothing is solved again
    assert np.array_equal(training(PROBLEM, 2).shapes, solved.shapes)


def test_newtons_samples_are_the_same_solutions(snapshots: ss.Snapshots) -> None:
    few, seconds = newton_samples(snapshots, 2)
    half = SAMPLES // 2
    assert np.array_equal(few.parameters, snapshots.parameters[half : half + 2])
    assert few.converged.all() and seconds > 0
    values = [report.value for report in snapshots.reports[half : half + 2]]
    assert [report.value for report in few.reports] == pytest.approx(values, rel=0.01)


def test_newtons_method_needs_samples_to_start_from(snapshots: ss.Snapshots) -> None:
    with pytest.raises(ValueError, match="count is 5, but must be between 1 and 4"):
        newton_samples(snapshots, 5)


def test_a_drag_counts_the_iterations_of_its_frames(snapshots: ss.Snapshots) -> None:
    subspace = ss.snapshot_pca(snapshots, dimension=6)
    model = ss.reduce(PROBLEM, subspace, snapshots=snapshots)
    newton, bfgs = drag(model, legs=1), drag(model, minimizer="bfgs", legs=1)
    for live in (newton, bfgs):
        assert live.iterations * LEG == pytest.approx(round(live.iterations * LEG))
        assert live.per_iteration and live.per_iteration > 0 and live.milliseconds > 0
    assert 0 < newton.iterations < bfgs.iterations, "BFGS builds its Hessian step by step"


def row(method: str, **figures: Any) -> dict[str, Any]:
    usual = {
        "shape": "bar",
        "material": "stvk",
        "method": method,
        "solved": 9,
        "converged": 9,
        "sampling, s": 9.0,
        "s a sample": 1.0,
        "coefficients, s": 2.0,
        "ms a frame": 0.1,
    }
    return usual | figures


PAPER = {"converged": None, "sampling, s": 90.0, "s a sample": 10.0, "ms a frame": 1.0}
NEWTON = {"s a sample": 5.0, "coefficients, s": None}


def test_times_in_the_right_order_pass() -> None:
    rows = [row("paper, beam", **PAPER), row("ours"), row("Newton, BFGS", **NEWTON)]
    assert times_in_order(rows) == []


@pytest.mark.parametrize(
    ("ours", "newton", "message"),
    [
        ({"converged": 8}, {}, "8 of 9 samples of ours converged"),
        ({}, {"converged": 7}, "7 of 9 samples of Newton, BFGS converged"),
        ({}, {"s a sample": 0.9}, "Newton's method is faster than our solver"),
        ({"coefficients, s": 90.0}, {}, "preparation takes 99 s, 92 s in the paper"),
        ({"ms a frame": 1.1}, {}, "a frame takes longer than in the paper"),
    ],
)
def test_times_in_another_order_are_reported(
    ours: dict[str, Any], newton: dict[str, Any], message: str
) -> None:
    rows = [row("paper", **PAPER), row("ours", **ours), row("Newton, BFGS", **(NEWTON | newton))]
    assert times_in_order(rows) == [f"bar, stvk: {message}"]
