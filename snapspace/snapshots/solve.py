"""solve_snapshots: full-space solutions of all samples."""

from __future__ import annotations

from concurrent.futures import Executor
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers, require_type, wrong_type
from ..problem import Problem, require_problem
from ..thread_count import checked_threads
from .check_solving import check_solving
from .checkpoint import Checkpoint
from .predictions import Predictions
from .run import Run
from .snapshots import Snapshots, check_snapshots_of
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
    predictions: Predictions | None = None,
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
        Called about ten times a second, from this thread. The error estimate in its reports needs
        the inner products of the samples, so these are computed during the run, and stored in the
        result (`gram`).
    checkpoint : Checkpoint, optional
        Where finished samples are saved, block by block and on Ctrl-C. A run with the same
        arguments continues from them and gives the same result as one that was not interrupted.
        Saved shapes need no memory, since they are mapped from the files. Samples that cannot be
        saved, for instance because the disk is full, stay in memory, and a `CheckpointNotice` says
        so.
    executor : concurrent.futures.Executor, optional
        A pool of processes, or a cluster (dask: `client.get_executor()`). Its workers, instead of
        `threads`, solve the samples, each block on one thread; the result is bitwise the same.
    known : Snapshots, optional
        Solutions of the same problem, or shapes near them, as starts for the new samples.
    predictions : Predictions, optional
        A reduced model's solutions for these samples, as starts and in seeds. Between poses, solves
        then take a third to a seventh of the iterations.

    Returns
    -------
    Snapshots
        The samples in the order of `parameters`, with their reports. Some may not be converged:
        `snapshot_pca` leaves these out.

    Raises
    ------
    ValueError
        For an argument of another type, parameters of the wrong shape or not finite,
        threads out of range, a checkpoint of another run, known snapshots of another problem,
        predictions for other samples or another mesh, or an executor that has lost its workers;
        then finished samples are in the checkpoint.
    Interrupted
        On Ctrl-C, after the finished samples have been saved.
    """
    who = "solve_snapshots"
    cure = "give a PosingProblem or InterpolationProblem first, then the parameters"
    require_problem(problem, who, cure=cure)
    check_solving(who, options, checkpoint, progress=progress)
    cure = "give Predictions, such as those of predicted_solutions"
    require_type(who, "predictions", predictions, Predictions | None, cure)
    if executor is not None and not hasattr(executor, "submit"):
        raise wrong_type(who, "executor", executor, "give a concurrent.futures.Executor, or None")
    samples = _checked(problem, parameters)
    if known is not None:
        check_snapshots_of(problem, known, who, "known")
    wanted = (len(samples), problem.base.size)
    if predictions is not None and predictions.displacements.shape != wanted:
        raise ValueError(
            f"{who}: predictions are for {predictions.displacements.shape} samples and "
            f"coordinates, but these are {wanted}"
        )
    run = Run(
        problem,
        samples,
        (options or SolverOptions()).resolved(problem),
        progress=progress,
        checkpoint=checkpoint,
        known=known,
        predictions=predictions,
        threads=checked_threads(threads, who),
    )
    return run.solve(executor)


def solver_key(options: SolverOptions, problem: Problem) -> dict[str, Any]:
    """The options on which the solutions of a problem depend."""
    return options.resolved(problem).as_key()


def _checked(problem: Problem, parameters: ArrayLike) -> FloatArray:
    samples = np.ascontiguousarray(as_numbers("solve_snapshots", "parameters", parameters))
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
