"""BlockTask: a block of samples as an executor's worker solves it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..interruptible import run_interruptible
from ..problem import Problem
from .fast_solve import as_sample_report, solve_fast
from .held_problems import HELD_PROBLEMS
from .solved import Solved
from .solver_options import ResolvedOptions
from .worker_names import worker_name

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class BlockTask:
    """A block of samples, without the problem.

    run : names the run, for tasks in its own process
    problem : key of the problem in workers' processes
    number : differs between all tasks of a run; an executor may take equal tasks for one
    samples, inputs, starts : k numbers, (k, input_size), (k, 3n)
    options : ResolvedOptions
    payload : the pickled problem, for a worker that has told that it needs it
    """

    run: str
    problem: str
    number: int
    samples: tuple[int, ...]
    inputs: FloatArray
    starts: FloatArray
    options: ResolvedOptions
    payload: bytes | None = None


@dataclass(frozen=True, eq=False)
class BlockAnswer:
    """What became of a block.

    worker : name of the process that had it
    solved : samples that are finished; None if the worker needs the problem
    """

    worker: str
    solved: list[Solved] | None


def solve_block(task: BlockTask) -> BlockAnswer:
    """Solves a block on one thread, in whatever process the executor runs this.

    In the run's own process the run's control ends it early, elsewhere Ctrl-C does: samples that
    are not finished then are missing in the answer.
    """
    worker = worker_name()
    home = HELD_PROBLEMS.home(task.run, task.options)
    if home is not None:
        return BlockAnswer(worker, _solved(task, home.problem, home.control))
    problem = HELD_PROBLEMS.received(task.problem, task.payload, task.options)
    if problem is None:
        return BlockAnswer(worker, None)
    solved, _ = run_interruptible(
        lambda control: _solved(task, problem, control), lambda finished: None
    )
    return BlockAnswer(worker, solved)


def _solved(task: BlockTask, problem: Problem, control: core.SolveControl) -> list[Solved]:
    options = task.options
    if options.solver == "fast":
        shapes, reports = solve_fast(problem, task.inputs, task.starts, control, options, threads=1)
    else:
        batch = problem.system.solve_newton(
            task.inputs,
            task.starts,
            tolerance=options.tolerance,
            max_iterations=options.max_iterations,
            projection=core.Projection[options.projection],
            threshold=options.clamp,
            threads=1,
            control=control,
        )
        shapes, reports = batch.shapes, [as_sample_report(report) for report in batch.reports]
    return [
        Solved(sample, shape, report)
        for sample, shape, report in zip(task.samples, shapes, reports, strict=True)
        if report.status != "cancelled"
    ]
