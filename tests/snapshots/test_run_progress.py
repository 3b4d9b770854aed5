"""Progress of a run: it never decreases, and reports the true error of unseen samples."""

from __future__ import annotations

from math import isfinite
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    Checkpoint,
    InterpolationProblem,
    PosingProblem,
    Snapshots,
    SolveProgress,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace.problem import solutions_beyond_tau
from snapspace.snapshots.held_out import DIMENSION

from ..shapes import interpolation_problem
from .bars import posing_bar
from .scripted_backend import Script

FloatArray = NDArray[np.float64]
Problem = PosingProblem | InterpolationProblem

PROBLEMS = {"posing": posing_bar(bound=0.7), "interpolation": interpolation_problem()}
both = pytest.mark.parametrize("kind", list(PROBLEMS))


def run_with_progress(
    problem: Problem,
    samples: FloatArray,
    options: SolverOptions,
    *,
    checkpoint: Checkpoint | None = None,
) -> tuple[Snapshots, list[SolveProgress]]:
    """A run that finishes one sample at a time in a random order, and its progress."""
    states: list[SolveProgress] = []
    with Script(seed=5).plays():
        found = solve_snapshots(
            problem, samples, options=options, progress=states.append, checkpoint=checkpoint
        )
    return found, states


def test_progress_counts_and_never_decreases() -> None:
    problem = PROBLEMS["posing"]
    _, states = run_with_progress(
        problem, sample(problem.domain, 22, seed=3), SolverOptions(block=4)
    )
    assert [state.done for state in states] == list(range(23))
    assert {state.total for state in states} == {22}
    seconds = [state.seconds for state in states]
    assert seconds == sorted(seconds) and seconds[0] >= 0.0
    assert states[0].eta is None and states[0].rate is None
    for state in states[1:]:
        assert state.solved == state.done
        assert state.rate is not None and state.eta is not None
        assert isfinite(state.eta) and state.eta >= 0.0
        assert state.eta * state.rate == pytest.approx(22 - state.done)
    assert states[-1].eta == 0.0


def test_samples_of_a_checkpoint_are_done_but_not_solved(tmp_path: Path) -> None:
    """As solved samples they would make the rate and the time left look better than they are."""
    problem = PROBLEMS["posing"]
    samples, options = sample(problem.domain, 12, seed=3), SolverOptions(block=4)
    whole, found = Checkpoint(tmp_path / "whole"), Checkpoint(tmp_path / "run")
    run_with_progress(problem, samples, options, checkpoint=whole)
    rows = whole.load()
    kept = [1, 3, 4, 8, 9]
    found.save(kept, [rows[i][0] for i in kept], [rows[i][1] for i in kept])
    _, states = run_with_progress(problem, samples, options, checkpoint=found)
    assert [(state.done, state.solved) for state in states] == [(5 + k, k) for k in range(8)]
    assert states[0].eta is None
    last = states[-1]
    assert last.rate == pytest.approx(7 / last.seconds)


def projection_error(
    problem: Problem, snapshots: Snapshots, before: int, stop: int
) -> float | None:
    """Median error of samples in the best subspace of all earlier ones, from dense shapes alone."""
    good = snapshots.converged
    known = solutions_beyond_tau(problem)[1]
    # in these coordinates the M-norm is the Euclidean one
    root = np.kron(np.linalg.cholesky(problem.mass().toarray()).T, np.eye(3))
    shapes, known = (root @ (x - problem.tau).T for x in (snapshots.shapes, known))
    training = np.hstack([shapes[:, :before][:, good[:before]], known])
    unseen = shapes[:, before:stop][:, good[before:stop]]
    if not training.shape[1] or not unseen.shape[1]:
        return None
    basis = np.linalg.svd(training, full_matrices=False)[0][:, :DIMENSION]
    misses = unseen - basis @ (basis.T @ unseen)
    errors = np.linalg.norm(misses, axis=0) / np.linalg.norm(unseen, axis=0)
    return float(np.median(errors))


@both
def test_the_error_of_unseen_samples_is_that_of_their_projection(kind: str) -> None:
    """Each block is projected onto all before it; the last one has more samples than dimensions."""
    problem = PROBLEMS[kind]
    # blocks that wait for each other, so that each one is reported
    options = SolverOptions(solver="newton", block=16)
    found, states = run_with_progress(problem, sample(problem.domain, 63, seed=3), options)
    errors = list(dict.fromkeys(state.held_out_error for state in states))
    expected = [projection_error(problem, found, k, min(k + 16, 63)) for k in range(0, 64, 16)]
    assert len(found) - 16 > DIMENSION
    if kind == "posing":
        assert errors[0] is None and expected[0] is None, "one block has nothing before it"
        errors, expected = errors[1:], expected[1:]
    else:
        assert errors.pop(0) is None, "no block is finished"
    # errors are differences of squares, which have half the digits
    np.testing.assert_allclose(
        np.array(errors, float), np.array(expected, float), rtol=1e-5, atol=1e-6
    )
    assert errors[-1] is not None and errors[0] is not None
    assert errors[-1] < errors[0], "more samples, less error"


def test_only_converged_samples_count() -> None:
    """Others are neither training nor unseen samples, as in `snapshot_pca`."""
    problem = PROBLEMS["posing"]
    options = SolverOptions(solver="newton", block=8, max_iterations=5)
    found, states = run_with_progress(problem, sample(problem.domain, 24, seed=3), options)
    good = found.converged
    assert all(0 < part.sum() < 8 for part in np.split(good, 3))
    assert states[-1].held_out_error == pytest.approx(
        projection_error(problem, found, 16, 24), rel=1e-5
    )


def test_a_block_without_any_converged_sample_has_no_error() -> None:
    problem = PROBLEMS["posing"]
    options = SolverOptions(block=4, max_iterations=1)
    _, states = run_with_progress(problem, sample(problem.domain, 12, seed=3), options)
    assert {state.held_out_error for state in states} == {None}
