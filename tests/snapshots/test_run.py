"""A run is bitwise the same whichever sample finishes first and wherever it was stopped."""

from __future__ import annotations

import random
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from snapspace import (
    Checkpoint,
    Interrupted,
    PosingProblem,
    Snapshots,
    SolveProgress,
    SolverOptions,
    solve_snapshots,
)
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from .bars import assert_same_bits, parameters, posing_bar
from .scripted_backend import Script

COUNT = 22  # the last block is not full
PROBLEM: PosingProblem = posing_bar(6, 2, 2, bound=0.7)
SAMPLES = parameters(PROBLEM, COUNT)
OPTIONS = {solver: SolverOptions(solver=solver, block=4) for solver in SOLVERS}

per_solver = pytest.mark.parametrize("solver", SOLVERS)
few = settings(max_examples=12)
any_samples = st.sets(st.integers(0, COUNT - 1))


@pytest.fixture(scope="module")
def wholes() -> Iterator[dict[Solver, tuple[Snapshots, Checkpoint]]]:
    """Uninterrupted runs, and their checkpoints."""
    with TemporaryDirectory() as folder:
        checkpoints = {solver: Checkpoint(Path(folder) / solver) for solver in SOLVERS}
        yield {
            solver: (solved(solver, checkpoint=checkpoint), checkpoint)
            for solver, checkpoint in checkpoints.items()
        }


Wholes = dict[Solver, tuple[Snapshots, Checkpoint]]


def solved(solver: Solver, *, checkpoint: Checkpoint | None = None, threads: int = 1) -> Snapshots:
    return solve_snapshots(
        PROBLEM,
        SAMPLES,
        options=OPTIONS[solver],
        threads=threads,
        checkpoint=checkpoint,
        progress=lambda state: None,
    )


def assert_same_run(found: Snapshots, whole: Snapshots) -> None:
    """Asserts the same bits, also of the Gram matrix, which the subspace needs."""
    assert_same_bits(found, whole)
    assert found.gram is not None and whole.gram is not None
    np.testing.assert_array_equal(found.gram.matrix, whole.gram.matrix)


@contextmanager
def folder_with(whole: Checkpoint, kept: set[int], seed: int) -> Iterator[Checkpoint]:
    """A checkpoint of some of a run's samples, as if they had finished in some order."""
    order = random.Random(seed)
    left = order.sample(sorted(kept), len(kept))
    samples = whole.load()
    with TemporaryDirectory() as folder:
        checkpoint = Checkpoint(Path(folder) / "run")
        while left:
            some, left = left[: (size := order.randint(1, 6))], left[size:]
            checkpoint.save(some, [samples[i][0] for i in some], [samples[i][1] for i in some])
        yield checkpoint


@per_solver
@few
@given(kept=any_samples, seed=st.integers(0, 2**32), threads=st.integers(1, 3))
def test_a_run_may_be_killed_with_any_samples_finished(
    wholes: Wholes, solver: Solver, kept: set[int], seed: int, threads: int
) -> None:
    whole, saved = wholes[solver]
    with folder_with(saved, kept, seed) as checkpoint:
        resumed = solved(solver, checkpoint=checkpoint, threads=threads)
        assert_same_run(resumed, whole)
        assert checkpoint.numbers() == set(range(COUNT))


@per_solver
@few
@given(seed=st.integers(0, 2**32))
def test_the_order_of_finishing_does_not_matter(wholes: Wholes, solver: Solver, seed: int) -> None:
    script = Script(seed)
    with script.plays():
        found = solved(solver)
    assert sorted(script.given) == list(range(COUNT))
    assert_same_run(found, wholes[solver][0])


@per_solver
@few
@given(stop=st.integers(0, COUNT - 1), seed=st.integers(0, 2**32))
def test_ctrl_c_saves_finished_samples(
    wholes: Wholes, solver: Solver, stop: int, seed: int
) -> None:
    def ctrl_c(given: int) -> None:
        if given == stop:
            raise KeyboardInterrupt

    script = Script(seed, ctrl_c)
    with TemporaryDirectory() as folder:
        checkpoint = Checkpoint(Path(folder) / "run")
        message = f"^{stop} of {COUNT} samples are finished$"
        with script.plays(), pytest.raises(Interrupted, match=message):
            solved(solver, checkpoint=checkpoint)
        assert checkpoint.numbers() == set(script.given)
        assert len(script.given) == stop
        assert_same_run(solved(solver, checkpoint=checkpoint), wholes[solver][0])


class BrokenDisplayError(Exception):
    """The error that a progress callable raises."""


@per_solver
def test_an_error_of_the_display_ends_the_run_and_keeps_finished_samples(
    wholes: Wholes, solver: Solver, tmp_path: Path
) -> None:
    checkpoint, error, seen = Checkpoint(tmp_path / "run"), BrokenDisplayError(), 0

    def display(state: SolveProgress) -> None:
        nonlocal seen
        seen = state.done
        if seen:  # at most 16 are submitted by then
            raise error

    before = set(threading.enumerate())
    with pytest.raises(BrokenDisplayError) as caught:
        solve_snapshots(
            PROBLEM,
            SAMPLES,
            options=OPTIONS[solver],
            threads=2,
            progress=display,
            checkpoint=checkpoint,
        )
    assert caught.value is error
    assert set(threading.enumerate()) <= before, "the solve must not continue after the error"
    assert seen <= len(checkpoint.numbers()) < COUNT
    assert_same_run(solved(solver, checkpoint=checkpoint), wholes[solver][0])


@per_solver
def test_a_finished_run_is_not_solved_again(wholes: Wholes, solver: Solver) -> None:
    whole, checkpoint = wholes[solver]

    def refuse(_: int) -> None:
        raise AssertionError("there is nothing to solve")

    states: list[SolveProgress] = []
    with Script(before_wait=refuse).plays():
        again = solve_snapshots(
            PROBLEM,
            SAMPLES,
            options=OPTIONS[solver],
            progress=states.append,
            checkpoint=checkpoint,
        )
    assert_same_run(again, whole)
    assert again.reports == whole.reports  # also the same seconds
    assert [(state.done, state.solved) for state in states] == [(COUNT, 0)]
