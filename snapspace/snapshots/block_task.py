"""BlockTask: a block of samples for a worker of an executor to solve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..interruptible import run_interruptible
from .fast_solve import as_sample_report, solve_fast
from .held_problems import HELD_PROBLEMS, HeldProblem
from .solved import Solved
from .solver_options import ResolvedOptions
from .worker_names import worker_name

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class BlockTask:
    """A block of samples, without the problem.

    run : id of the run, for tasks in its own process
    problem : key of the problem in workers' processes
    number : unique among the tasks of a run, since an executor may merge equal tasks
    samples, inputs, starts : k numbers, (k, input_size), (k, 3n)
    options : ResolvedOptions
    payload : the pickled problem, for a worker that has asked for it
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
    """A worker's answer to a block.

    worker : name of the worker's process
    solved : finished samples; None if the worker needs the problem
    """

    worker: str
    solved: list[Solved] | None


def solve_block(task: BlockTask) -> BlockAnswer:
    """Solves a block on one thread, in any process of the executor.

    In the run's own process the run's control can end the solve early; in other processes Ctrl-C
    can. Then unfinished samples are missing in the answer.
    """
    worker = worker_name()
    context = HELD_PROBLEMS.run_context(task.run, task.options)
    if context is not None:
        return BlockAnswer(worker, _solved(task, context.held, context.control))
    held = HELD_PROBLEMS.received(task.problem, task.payload, task.options)
    if held is None:
        return BlockAnswer(worker, None)
    solved, _ = run_interruptible(
        lambda control: _solved(task, held, control), lambda finished: None
    )
    return BlockAnswer(worker, solved)


def _solved(task: BlockTask, held: HeldProblem, control: core.SolveControl) -> list[Solved]:
    problem, options, arrays = held.problem, task.options, (task.inputs, task.starts)
    if options.solver == "fast":
        shapes, reports = solve_fast(
            problem, *arrays, control, options, threads=1, coarse=held.coarse
        )
    else:
        batch = problem.system.solve_newton(
            *arrays,
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
