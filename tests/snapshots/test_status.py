"""What reports say, and what is refused."""

from __future__ import annotations

import re
import threading
from typing import Any

import numpy as np
import pytest

from snapspace import SolveProgress, SolverOptions, snapshot_pca, solve_snapshots
from snapspace.snapshots import SOLVERS, SampleReport
from snapspace.snapshots.solver_options import Precision, Solver

from .bars import parameters, posing_bar


@pytest.mark.parametrize(
    ("solver", "precision", "rounding"),
    [("newton", "double", 1e-12), ("fast", "double", 1e-12), ("fast", "single", 1e-6)],
)
def test_a_tiny_budget_is_reported(solver: Solver, precision: Precision, rounding: float) -> None:
    """The rest pose needs no iteration; the numbers agree to the rounding of the precision."""
    problem = posing_bar()
    samples = np.vstack([parameters(problem, 5), np.zeros((1, 6))])
    options = SolverOptions(solver=solver, max_iterations=2, precision=precision)
    solved = solve_snapshots(problem, samples, options=options, threads=1)
    assert [r.status for r in solved.reports] == ["max_iterations"] * 5 + ["converged"]
    assert [r.iterations for r in solved.reports] == [2] * 5 + [0]
    assert solved.converged.tolist() == [False] * 5 + [True]
    assert solved.summary() == (
        "1 of 6 samples converged, 5 max_iterations, 2 iterations on average, "
        "at most 0 inverted tets"
    )
    for w, x, report in zip(samples, solved.shapes, solved.reports, strict=True):
        value, gradient = problem.value_and_gradient(x, w)  # the report is of the returned shape
        assert report.value == pytest.approx(value, rel=rounding)
        norm = float(np.linalg.norm(gradient))
        assert report.gradient_norm == pytest.approx(norm, rel=1e3 * rounding)


@pytest.mark.parametrize("solver", SOLVERS)
def test_unconverged_snapshots_start_no_others(solver: Solver) -> None:
    """Later blocks start at rest, as if the blocks that they wait for did not exist."""
    problem = posing_bar()
    samples = parameters(problem, 16)
    options = SolverOptions(solver=solver, max_iterations=2, block=4)
    after = solve_snapshots(problem, samples, options=options, threads=1)
    alone = solve_snapshots(problem, samples[8:], options=options, threads=1)
    assert not after.converged.any()
    np.testing.assert_array_equal(after.shapes[8:], alone.shapes)


def test_unconverged_snapshots_are_left_out_of_the_basis() -> None:
    problem = posing_bar(bound=0.7)
    samples = parameters(problem, 12)
    solved = solve_snapshots(problem, samples, threads=1)
    counts = [report.iterations for report in solved.reports]
    options = SolverOptions(max_iterations=int(np.quantile(counts, 0.4)))
    partly = solve_snapshots(problem, samples, options=options, threads=1)
    good = int(partly.converged.sum())
    assert 1 < good < 12
    with pytest.raises(ValueError, match=f"{good} independent directions of {good} usable"):
        snapshot_pca(partly, dimension=good + 1)
    chosen = snapshot_pca(partly, dimension=good)
    same = snapshot_pca(solved.select(partly.converged), dimension=good)
    np.testing.assert_array_equal(chosen.basis, same.basis)
    assert snapshot_pca(partly, dimension=12, include_unconverged=True).dimension == 12


def test_inverted_tets_are_counted() -> None:
    """A bar pushed through its own foot must have inverted tets; the energy counts them."""
    problem = posing_bar(bound=3.0)
    solved = solve_snapshots(problem, [[-3.0, 0.0, 0.0, 0.0, 0.0, 0.0]], threads=1)
    assert solved.reports[0].inverted_tets > 0
    assert solved.reports[0].inverted_tets == problem.energy.inverted_tets(solved.shapes[0])
    assert f"at most {solved.reports[0].inverted_tets} inverted tets" in solved.summary()


def test_progress_rises_to_the_total_on_the_callers_thread() -> None:
    problem = posing_bar()
    calls: list[tuple[int, int]] = []
    threads = set()

    def progress(state: SolveProgress) -> None:
        calls.append((state.done, state.total))
        threads.add(threading.current_thread())

    options = SolverOptions(solver="newton", block=3)  # Newton's blocks wait for each other
    solve_snapshots(problem, parameters(problem, 7), options=options, progress=progress)
    done = [call[0] for call in calls]
    assert {total for _, total in calls} == {7}
    assert done == sorted(done) and calls[-1] == (7, 7)
    assert set(done) >= {0, 3, 6}
    assert threads == {threading.current_thread()}


def test_reports_say_whether_they_converged() -> None:
    report = SampleReport("line_search_failed", 3, 40, 1.0, 2.0, 3.0, 0.1, 0)
    assert not report.converged


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"solver": "slow"}, "unknown solver 'slow'; known are fast, newton"),
        ({"tolerance": 0.0}, "tolerance is 0.0, but it must be positive"),
        ({"tolerance": float("nan")}, "tolerance is nan, but it must be positive"),
        ({"tolerance": float("inf")}, "tolerance is inf, but it must be positive"),
        ({"max_iterations": 0}, "max_iterations is 0, but must be at least 1"),
        ({"max_iterations": 10**30}, "0, but must be at most 2147483647"),
        ({"clamp": 0.0}, "clamp is 0.0, but it must be in (0, 1]"),
        ({"clamp": 1.5}, "clamp is 1.5, but it must be in (0, 1]"),
        ({"precision": "half"}, "unknown precision 'half'; known are single, double"),
        ({"block": 0}, "block is 0, but must be at least 1"),
    ],
)
def test_refuses_options(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match="^SolverOptions: .*" + re.escape(message)):
        SolverOptions(**options)


@pytest.mark.parametrize(
    ("samples", "message"),
    [
        (np.zeros(6), "parameters have shape (6,), but the problem needs (samples, 6)"),
        (np.zeros((2, 7)), "parameters have shape (2, 7), but the problem needs (samples, 6)"),
        (np.zeros((0, 6)), "parameters have shape (0, 6), but the problem needs (samples, 6)"),
        ([[0.0] * 6, [0.0] * 5 + [np.nan]], "sample 1 has a parameter that is not finite"),
        ([[np.inf] + [0.0] * 5], "sample 0 has a parameter that is not finite"),
    ],
)
def test_refuses_parameters(samples: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        solve_snapshots(posing_bar(), samples)
