"""solve_snapshots: full-space solutions of all samples."""

from __future__ import annotations

from concurrent.futures import Executor
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..problem import Problem
from ..thread_count import checked_threads
from .checkpoint import Checkpoint
from .run import Run
from .snapshots import Snapshots
from .solve_progress import Progress
from .solver_options import SolverOptions

FloatArray = NDArray[np.float64]


def solve_snapshots(
    problem: Problem,
    parameters: ArrayLike,
    *,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    known: Snapshots | None = None,
) -> Snapshots:
    """Solves the full nonlinear problem for each sample (paper, sec. 4.2).

    Parameters
    ----------
    problem : Problem
    parameters : array_like, (k, problem.parameter_count)
        For example from `sample`.
    options : SolverOptions, optional
    threads : int, optional
        Default: as many as the machine has. The result is bitwise the same for any number.
    progress : callable(SolveProgress), optional
        Called some ten times a second, from this thread. With it the inner products of the samples
        are measured on the way, which its error estimate needs, and kept in the result (`gram`).
    checkpoint : Checkpoint, optional
        Finished samples are saved there block by block, and on Ctrl-C; a run with the same
        arguments goes on from them and ends with the same result as one that was not interrupted.
        Saved shapes need no memory: they are mapped from the files. Samples that cannot be saved,
        because the disk is full for instance, stay in memory, with a `CheckpointNotice`.
    executor : concurrent.futures.Executor, optional
        Its workers solve the samples, a block on one thread each, instead of `threads`; the result
        has the same bits. A pool of processes, or a cluster (dask: `client.get_executor()`).
    known : Snapshots, optional
        Of the same problem: solutions, or shapes near them, that the new samples may start from.

    Returns
    -------
    Snapshots
        In the order of `parameters`, with a report each. Not every sample has to be converged:
        `snapshot_pca` leaves out those that are not.

    Raises
    ------
    ValueError
        For parameters of the wrong shape or not finite, threads out of range, known snapshots of
        another problem, or an executor that has lost its workers; finished samples are in the
        checkpoint then.
    Interrupted
        On Ctrl-C, after the finished samples were saved.
    """
    samples = _checked(problem, parameters)
    if known is not None:
        known.check_known(problem, "solve_snapshots")
    run = Run(
        problem,
        samples,
        (options or SolverOptions()).resolved(problem),
        progress=progress,
        checkpoint=checkpoint,
        known=known,
        threads=checked_threads(threads, "solve_snapshots"),
    )
    return run.solve(executor)


def solver_key(options: SolverOptions, problem: Problem) -> dict[str, Any]:
    """What of the options the solutions of a problem depend on."""
    return options.resolved(problem).as_key()


def _checked(problem: Problem, parameters: ArrayLike) -> FloatArray:
    samples = np.ascontiguousarray(parameters, dtype=np.float64)
    if samples.ndim != 2 or samples.shape[1] != problem.parameter_count or len(samples) == 0:
        raise ValueError(
            f"solve_snapshots: parameters have shape {samples.shape}, but the problem needs "
            f"(samples, {problem.parameter_count})"
        )
    bad = np.flatnonzero(~np.isfinite(samples).all(axis=1))
    if bad.size:
        raise ValueError(f"solve_snapshots: sample {bad[0]} has a parameter that is not finite")
    for index, w in enumerate(samples):
        try:
            problem.check(w)
        except ValueError as error:
            raise ValueError(f"solve_snapshots: sample {index}: {error}") from None
    return samples
