"""Samples between poses are bitwise the same for any threads, neighbours and interruptions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    Checkpoint,
    InterpolationProblem,
    Interrupted,
    SolveProgress,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from ..shapes import interpolation_problem
from .bars import assert_same_bits, core_solve

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return interpolation_problem(extrapolation=0.3)


def weights(problem: InterpolationProblem, count: int) -> FloatArray:
    return sample(problem.domain, count, seed=3)


@pytest.mark.parametrize("solver", SOLVERS)
def test_threads_do_not_change_a_bit(problem: InterpolationProblem, solver: Solver) -> None:
    samples = weights(problem, 21)
    options = SolverOptions(solver=solver, block=9)
    one, two, four = (
        solve_snapshots(problem, samples, options=options, threads=threads) for threads in (1, 2, 4)
    )
    assert one.converged.all()
    assert_same_bits(two, one)
    assert_same_bits(four, one)


def test_the_problem_carries_nothing_from_run_to_run(problem: InterpolationProblem) -> None:
    """That includes the mean shape, which is solved for again."""
    samples = weights(problem, 5)
    fresh = interpolation_problem(extrapolation=0.3)
    assert np.array_equal(fresh.tau, problem.tau)
    assert np.array_equal(fresh.pose_shapes, problem.pose_shapes)
    assert_same_bits(
        solve_snapshots(fresh, samples, threads=1), solve_snapshots(problem, samples, threads=1)
    )


def solve_batch(problem: InterpolationProblem, solver: Solver, samples: FloatArray) -> core.Batch:
    """One call of the core from starts that belong to the samples."""
    noise = np.sin(np.arange(problem.base.size))
    starts = problem.tau - problem.base + 0.1 * np.outer(samples[:, 0], noise)
    return core_solve(problem, solver, samples, starts, tolerance=1e-6, max_iterations=500)  # type: ignore[arg-type]


def counts(batch: core.Batch) -> list[tuple[str, int, int, float, float]]:
    return [
        (r.status.name, r.iterations, r.evaluations, r.value, r.gradient_norm)
        for r in batch.reports
    ]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_sample_does_not_see_its_neighbours(
    problem: InterpolationProblem, solver: Solver
) -> None:
    samples = weights(problem, 19)
    together = solve_batch(problem, solver, samples)
    assert len({entry[1] for entry in counts(together)}) > 2, "the paths must differ"
    permuted = np.random.default_rng(0).permutation(19)
    for which in (permuted, np.arange(0, 19, 2), *permuted[:4, None]):
        part = solve_batch(problem, solver, samples[which])
        np.testing.assert_array_equal(part.shapes, together.shapes[which])
        assert counts(part) == [counts(together)[i] for i in which]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_sample_that_overflows_leaves_the_others_alone(
    problem: InterpolationProblem, solver: Solver
) -> None:
    samples = weights(problem, 6)
    together = solve_batch(problem, solver, samples)
    spoilt = samples.copy()
    spoilt[2] = [1e308, 1e308, 1e308]
    beside = solve_batch(problem, solver, spoilt)
    assert counts(beside)[2][0] == "not_finite"
    others = np.array([0, 1, 3, 4, 5])
    np.testing.assert_array_equal(beside.shapes[others], together.shapes[others])


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_resumed_run_ends_like_one_that_was_not_interrupted(
    problem: InterpolationProblem, solver: Solver, tmp_path: Path
) -> None:
    samples = weights(problem, 30)
    options = SolverOptions(solver=solver, block=4)
    checkpoint = Checkpoint(tmp_path / "run")

    def progress(state: SolveProgress) -> None:
        if state.done >= 4:  # at most 24 are submitted by then
            raise KeyboardInterrupt

    with pytest.raises(Interrupted):
        solve_snapshots(
            problem, samples, options=options, threads=1, progress=progress, checkpoint=checkpoint
        )
    assert 4 <= len(checkpoint.load()) < 30
    resumed = solve_snapshots(
        interpolation_problem(extrapolation=0.3),
        samples,
        options=options,
        threads=2,
        checkpoint=checkpoint,
    )
    assert_same_bits(resumed, solve_snapshots(problem, samples, options=options, threads=1))


@pytest.mark.parametrize("indices", [[0, 2], [3], [0, 1, 2, 3, 5], [*range(8), 9]])
def test_any_finished_samples_lead_to_the_same_end(
    problem: InterpolationProblem, tmp_path: Path, indices: list[int]
) -> None:
    samples, options = weights(problem, 10), SolverOptions(block=4)
    everything, some = Checkpoint(tmp_path / "everything"), Checkpoint(tmp_path / "some")
    whole = solve_snapshots(problem, samples, options=options, threads=1, checkpoint=everything)
    found = everything.load()
    displacements = np.array([found[i][0] for i in indices])
    some.save(indices, displacements, [found[i][1] for i in indices])
    resumed = solve_snapshots(problem, samples, options=options, threads=1, checkpoint=some)
    assert_same_bits(resumed, whole)
