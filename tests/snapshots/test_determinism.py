"""The same bits for any number of threads and any other samples in the run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import PosingProblem, SolverOptions, solve_snapshots
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from .bars import assert_same_bits, core_solve, parameters, posing_bar

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    # wide enough for refused steps, restarts and inverted tets: paths differ from sample to sample
    return posing_bar(bound=0.7)


@pytest.mark.parametrize("solver", SOLVERS)
def test_threads_do_not_change_a_bit(problem: PosingProblem, solver: Solver) -> None:
    samples = parameters(problem, 21)
    options = SolverOptions(solver=solver, block=9)
    runs = [
        solve_snapshots(problem, samples, options=options, threads=threads) for threads in (1, 2, 4)
    ]
    assert_same_bits(runs[1], runs[0])
    assert_same_bits(runs[2], runs[0])


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_problem_carries_nothing_from_run_to_run(
    problem: PosingProblem, solver: Solver
) -> None:
    """Runs share factors but no state: a new problem gives the same bits as a used one."""
    samples = parameters(problem, 5)
    options = SolverOptions(solver=solver)
    used = solve_snapshots(problem, samples, options=options, threads=1)
    fresh = solve_snapshots(posing_bar(bound=0.7), samples, options=options, threads=1)
    assert_same_bits(fresh, used)


def solve_batch(problem: PosingProblem, solver: Solver, samples: FloatArray) -> dict[str, Any]:
    """One call of the core from starts that belong to the samples."""
    targets = np.stack([problem.target_displacements(problem.offsets(w)) for w in samples])
    starts = np.outer(samples[:, 0], np.sin(np.arange(problem.mesh.vertices.size))) * 0.1
    batch = core_solve(problem, solver, targets, starts, tolerance=1e-6, max_iterations=500)
    return {
        "shapes": batch.shapes,
        "status": [r.status.name for r in batch.reports],
        "counts": [(r.iterations, r.evaluations, r.inverted_tets) for r in batch.reports],
        "values": [(r.value, r.gradient_norm, r.decrement) for r in batch.reports],
    }


def picked(results: dict[str, Any], which: NDArray[np.intp]) -> dict[str, Any]:
    return {
        "shapes": results["shapes"][which],
        **{key: [results[key][i] for i in which] for key in ("status", "counts", "values")},
    }


def assert_equal(a: dict[str, Any], b: dict[str, Any]) -> None:
    np.testing.assert_array_equal(a["shapes"], b["shapes"])
    assert [a[key] for key in ("status", "counts", "values")] == [
        b[key] for key in ("status", "counts", "values")
    ]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_sample_does_not_see_its_neighbours(problem: PosingProblem, solver: Solver) -> None:
    """Lanes share only instructions: permuted, halved or alone, a sample is the same."""
    samples = parameters(problem, 19)
    together = solve_batch(problem, solver, samples)
    assert len(set(together["counts"])) > 5, "the paths must differ for a meaningful test"
    permuted = np.random.default_rng(0).permutation(19)
    for which in (permuted, np.arange(0, 19, 2), *permuted[:4, None]):
        assert_equal(solve_batch(problem, solver, samples[which]), picked(together, which))


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_sample_that_overflows_leaves_the_others_alone(
    problem: PosingProblem, solver: Solver
) -> None:
    samples = parameters(problem, 6)
    together = solve_batch(problem, solver, samples)
    spoilt = samples.copy()
    spoilt[2, :3] = 1e200
    with np.errstate(over="ignore"):
        beside = solve_batch(problem, solver, spoilt)
    others = np.array([0, 1, 3, 4, 5])
    assert beside["status"][2] == "not_finite"
    assert_equal(picked(beside, others), picked(together, others))
