"""Blocks of samples for the executor backend, and their expected solutions."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import _core as core
from snapspace.problem import Problem
from snapspace.sampling import sample
from snapspace.snapshots import SampleReport
from snapspace.snapshots.executor_backend import ExecutorBackend
from snapspace.snapshots.fast_solve import as_sample_report, solve_fast
from snapspace.snapshots.solved import Solved
from snapspace.snapshots.solver_options import ResolvedOptions

FloatArray = NDArray[np.float64]
Outcome = tuple[FloatArray, SampleReport]

OPTIONS = ResolvedOptions(
    settling=0.0,
    soft_modes=False,
    solver="fast",
    tolerance=1e-10,
    max_iterations=1000,
    projection="stretches",
    clamp=0.65,
    single=False,
    block=16,
)
PATIENCE = 60.0  # seconds


@dataclass(frozen=True)
class Work:
    """Samples of a problem with their inputs and starts, to be cut into blocks."""

    problem: Problem
    inputs: FloatArray
    starts: FloatArray

    @classmethod
    def of(cls, problem: Problem, count: int, *, seed: int = 3) -> Work:
        inputs = problem.inputs(sample(problem.domain, count, seed=seed))
        _, shapes = problem.known_solutions()
        starts = np.repeat(shapes[:1] - problem.base, count, axis=0)
        return cls(problem, inputs, starts)

    def submit(self, backend: ExecutorBackend, size: int) -> None:
        for begin in range(0, len(self.inputs), size):
            rows = np.arange(begin, min(begin + size, len(self.inputs)))
            backend.submit(rows.tolist(), self.inputs[rows], self.starts[rows])

    def solved_here(self, options: ResolvedOptions = OPTIONS) -> dict[int, Outcome]:
        """Solves all samples in one call of the solver, without tasks."""
        arrays, control = (self.inputs, self.starts), core.SolveControl()
        if options.solver == "fast":
            shapes, reports = solve_fast(self.problem, *arrays, control, options, threads=2)
        else:
            batch = self.problem.system.solve_newton(
                *arrays,
                tolerance=options.tolerance,
                max_iterations=options.max_iterations,
                projection=core.Projection[options.projection],
                threshold=options.clamp,
                threads=2,
                control=control,
            )
            shapes, reports = batch.shapes, [as_sample_report(one) for one in batch.reports]
        return {k: (shapes[k], report) for k, report in enumerate(reports)}


def backend_of(
    executor: Executor, problem: Problem, options: ResolvedOptions = OPTIONS
) -> ExecutorBackend:
    return ExecutorBackend(executor, problem, options)


def collected(
    backend: ExecutorBackend, count: int, *, after_each: Callable[[int], None] | None = None
) -> dict[int, Outcome]:
    """Waits until `count` samples are back, each once; `after_each` gets the number so far."""
    found: dict[int, Outcome] = {}
    while len(found) < count:
        solved = backend.wait(PATIENCE)
        assert solved, "nothing is running, but samples are missing"
        fresh = outcomes(solved)
        assert not set(fresh) & set(found), "a sample came back twice"
        found.update(fresh)
        if after_each is not None:
            after_each(len(found))
    return found


def sent_once(
    executor: Executor, problem: Problem, workers: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run sends its problem to each worker process once, and not with later blocks.

    Samples are bitwise those of one call, whichever worker solves them.
    """
    solvers = watched_solvers(executor, monkeypatch)
    work, backend = Work.of(problem, 24), backend_of(executor, problem)
    expected = work.solved_here()
    end = time.monotonic() + PATIENCE
    while len(solvers()) < workers:  # on a busy machine one process may solve all blocks at first
        assert time.monotonic() < end, f"blocks were solved by {solvers()} only"
        work.submit(backend, 2)
        assert_same_outcomes(collected(backend, 24), expected)
    sent = backend.payloads_sent
    # a payload may reach a process that already has it, while another process asks again
    assert workers <= sent <= 2 * workers
    work.submit(backend, 2)
    assert_same_outcomes(collected(backend, 24), expected)
    assert backend.payloads_sent == sent, "later blocks need no payload"


def watched_solvers(executor: Executor, monkeypatch: pytest.MonkeyPatch) -> Callable[[], set[str]]:
    """Returns a function that names the workers that have solved blocks since this call."""
    futures: list[Any] = []
    submit = executor.submit

    def watched(*task: Any, **place: Any) -> Any:
        futures.append(submit(*task, **place))
        return futures[-1]

    monkeypatch.setattr(executor, "submit", watched)

    def names() -> set[str]:
        answers = [future.result() for future in futures if future.done()]
        return {answer.worker for answer in answers if answer.solved is not None}

    return names


def outcomes(solved: Iterable[Solved]) -> dict[int, Outcome]:
    return {one.sample: (one.displacement, one.report) for one in solved}


def assert_same_outcomes(found: dict[int, Outcome], expected: dict[int, Outcome]) -> None:
    """Asserts the same bits, except for the wall time."""
    assert sorted(found) == sorted(expected)
    for sample_number, (shape, report) in expected.items():
        np.testing.assert_array_equal(found[sample_number][0], shape)
        assert replace(found[sample_number][1], seconds=0.0) == replace(report, seconds=0.0)


class DeadlyProblem:
    """Ends the process that unpickles it, as if the process ran out of memory."""

    tau = np.zeros(3)

    def __reduce__(self) -> tuple[Callable[[int], Any], tuple[int]]:
        return os._exit, (1,)
