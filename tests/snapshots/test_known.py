"""Known solutions serve as starts: they save iterations and change no minimum."""

from __future__ import annotations

import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from snapspace import (
    Checkpoint,
    PosingProblem,
    Snapshots,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from ..shapes import interpolation_problem
from .bars import assert_same_bits, parameters, posing_bar, tight, without_seconds


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    return posing_bar()


@pytest.fixture(scope="module")
def known(problem: PosingProblem) -> Snapshots:
    return solve_snapshots(problem, parameters(problem, 24), options=tight("newton"), threads=1)


def iterations(snapshots: Snapshots) -> list[int]:
    return [report.iterations for report in snapshots.reports]


def values(snapshots: Snapshots) -> list[float]:
    return [report.value for report in snapshots.reports]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_known_solution_takes_no_iterations(
    problem: PosingProblem, known: Snapshots, solver: Solver
) -> None:
    """In single precision there may be one iteration, from a number to its rounding."""
    wanted = known.parameters[[17, 3, 8]]
    found = solve_snapshots(
        problem, wanted, options=SolverOptions(solver=solver), threads=1, known=known
    )
    assert found.converged.all()
    assert max(iterations(found)) <= 1
    np.testing.assert_allclose(found.shapes, known.shapes[[17, 3, 8]], atol=1e-6)


def test_between_poses_a_known_solution_takes_hardly_any_iterations() -> None:
    problem = interpolation_problem()
    options = SolverOptions(tolerance=1e-11)
    known = solve_snapshots(problem, sample(problem.domain, 12, seed=2), options=options, threads=1)
    found = solve_snapshots(problem, known.parameters[[5, 1]], threads=1, known=known)
    assert found.converged.all()
    assert max(iterations(found)) <= 2
    assert min(iterations(solve_snapshots(problem, known.parameters[[5, 1]], threads=1))) > 20


@pytest.mark.parametrize("solver", SOLVERS)
def test_solutions_nearby_save_iterations_and_change_no_minimum(
    problem: PosingProblem, known: Snapshots, solver: Solver
) -> None:
    wanted = parameters(problem, 12, seed=9)
    options = SolverOptions(solver=solver, tolerance=1e-12, block=12)
    cold = solve_snapshots(problem, wanted, options=options, threads=1)
    warm = solve_snapshots(problem, wanted, options=options, threads=1, known=known)
    assert warm.converged.all()
    assert sum(iterations(warm)) < sum(iterations(cold))
    np.testing.assert_allclose(values(warm), values(cold), rtol=1e-11)


def test_later_blocks_start_from_them_too(problem: PosingProblem, known: Snapshots) -> None:
    """They use them beside the samples of earlier blocks."""
    wanted = np.vstack([parameters(problem, 16, seed=9), known.parameters[[2, 11, 20, 5]]])
    found = solve_snapshots(problem, wanted, options=SolverOptions(block=4), threads=1, known=known)
    assert max(iterations(found)[16:]) <= 1


def test_samples_that_did_not_converge_are_not_starts(problem: PosingProblem) -> None:
    """They may be anywhere; a run without them is bitwise the same."""
    samples, wanted = parameters(problem, 6), parameters(problem, 6, seed=9)
    whole = solve_snapshots(problem, samples, threads=1)
    middle = int(np.median([report.iterations for report in whole.reports]))
    enough = SolverOptions(max_iterations=middle)
    some = solve_snapshots(problem, samples, options=enough, threads=1)
    assert 0 < some.converged.sum() < 6
    given = solve_snapshots(problem, wanted, threads=1, known=some)
    chosen = solve_snapshots(problem, wanted, threads=1, known=some.select(some.converged))
    assert_same_bits(given, chosen)
    none = solve_snapshots(problem, samples, options=SolverOptions(max_iterations=1), threads=1)
    assert not none.converged.any()
    assert_same_bits(
        solve_snapshots(problem, wanted, threads=1, known=none),
        solve_snapshots(problem, wanted, threads=1),
    )


def test_known_solutions_are_not_changed(problem: PosingProblem, known: Snapshots) -> None:
    shapes, reports = known.shapes.copy(), without_seconds(known)
    solve_snapshots(problem, parameters(problem, 4, seed=9), threads=1, known=known)
    np.testing.assert_array_equal(known.shapes, shapes)
    assert without_seconds(known) == reports


def test_known_solutions_are_the_same_for_threads_executors_and_interruptions(
    problem: PosingProblem, known: Snapshots, tmp_path: Path
) -> None:
    wanted, options = parameters(problem, 16, seed=9), SolverOptions(block=4)
    whole = Checkpoint(tmp_path / "whole")
    one = solve_snapshots(
        problem, wanted, options=options, threads=1, known=known, checkpoint=whole
    )
    three = solve_snapshots(problem, wanted, options=options, threads=3, known=known)
    assert_same_bits(three, one)
    with ThreadPoolExecutor(2) as pool:
        there = solve_snapshots(problem, wanted, options=options, executor=pool, known=known)
    assert_same_bits(there, one)
    rows, kept, part = whole.load(), [1, 2, 9, 14], Checkpoint(tmp_path / "part")
    part.save(kept, [rows[i][0] for i in kept], [rows[i][1] for i in kept])
    resumed = solve_snapshots(
        problem, wanted, options=options, threads=1, known=known, checkpoint=part
    )
    assert_same_bits(resumed, one)


def test_solutions_of_another_problem_are_refused(known: Snapshots) -> None:
    """Their shapes may have another size, or be far from the solutions."""
    other = posing_bar(stiffness=999.0)
    message = "solve_snapshots: the snapshots are of another problem; `carry_over` makes them"
    with pytest.raises(ValueError, match=re.escape(message)):
        solve_snapshots(other, parameters(other, 2), known=known)
