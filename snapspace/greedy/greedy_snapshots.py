"""greedy_snapshots: solves samples where the model of earlier ones is worst, up to a target."""

from __future__ import annotations

from concurrent.futures import Executor

import numpy as np
from numpy.typing import NDArray

from ..arguments import check_target, require_count
from ..displacements import SnapshotGram
from ..input_error import located
from ..problem import InterpolationProblem, PosingProblem, require_problem
from ..sampling import sample
from ..snapshots import (
    Checkpoint,
    Interrupted,
    Progress,
    Snapshots,
    SolverOptions,
    check_snapshots_of,
    check_solving,
    solve_snapshots,
)
from .batch_checkpoints import batch_checkpoint
from .batch_progress import BatchProgress
from .error_estimates import estimated_errors
from .largest_pivots import largest_pivots
from .solved_so_far import SolvedSoFar

FloatArray = NDArray[np.float64]

BATCH, CANDIDATES = 32, 3


def greedy_snapshots(
    problem: PosingProblem | InterpolationProblem,
    count: int,
    *,
    target: float | None = None,
    dimension: int = 40,
    batch: int = BATCH,
    candidates: int = CANDIDATES,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    known: Snapshots | None = None,
) -> Snapshots:
    """Solves batches of samples, each where a reduced model of the earlier ones is worst.

    The first batch is the beginning of a scrambled Sobol sequence. For each later batch a reduced
    model with d <= 20 is made, and solved at the next `candidates * batch` points of the sequence.
    The batch consists of the points whose `estimated_errors` are large and differ from each other,
    see `largest_pivots`. If the model needs a cubature and there are fewer than ten samples to
    train it on, the batch consists of the first points. This is the greedy method of reduced bases
    (Veroy, Prud'homme, Rovas & Patera 2003) with a different indicator, and in batches.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
        The problem to sample.
    count : int
        Largest number of samples to solve.
    target : float, optional
        The run ends after the first batch whose median held-out error is below this. That error is
        the relative error, in the M-norm, of projections onto the best subspace of the earlier
        samples. Tight solutions at unseen parameters have larger errors, since new samples start
        from blends of earlier ones and stay near them.
    dimension : int, default 40
        Dimension of that subspace, which limits the error that can be reached.
    batch : int, default 32
        Number of samples per batch.
    candidates : int, default 3
        Number of points that each sample is chosen from. With 1 the sequence is used as it is,
        without a model: Sobol sampling that ends at the target.
    seed : int, default 0
        Seed of the sequence.
    options, threads, progress, executor : as for `solve_snapshots`
    checkpoint : Checkpoint, optional
        As for `solve_snapshots`; each batch has its own folder inside that of the checkpoint.
    known : Snapshots, optional
        Samples of the same problem, solved or carried over. The model uses them, so even the first
        batch is chosen, and solves start from them.

    Returns
    -------
    Snapshots
        The samples in the order of choice, without the known ones; all parameters differ. The same
        arguments give bitwise the same samples for any number of threads, with any executor, and
        after interruptions.

    Raises
    ------
    ValueError
        For an argument of another type, a number out of range, known snapshots of another problem,
        or a first batch without a usable sample.
    Interrupted
        On Ctrl-C, after the finished samples have been saved.

    Notes
    -----
    For the same number of samples the result is a few percent better or worse than that of the
    Sobol sequence, and for the same time it is worse, see docs/notes/sampling.md. PCA minimises a
    mean over the samples, so samples that are spread over the whole domain are best for the mean
    over the domain.
    """
    require_problem(problem, "greedy_snapshots")
    _check(problem, known, count=count, dimension=dimension, batch=batch, candidates=candidates)
    if target is not None:
        with located("greedy_snapshots"):
            check_target(target)
    check_solving("greedy_snapshots", options, checkpoint, progress=progress)
    options = options or SolverOptions()
    so_far = SolvedSoFar(problem, known, dimension)
    batch_progress = BatchProgress(progress, count) if progress else None
    sizes = _sizes(count, batch, candidates, chosen=so_far.snapshots is not None)
    sequence = sample(problem.domain, sum(sizes), method="sobol", seed=seed)
    done = 0
    for points in np.split(sequence, np.cumsum(sizes)[:-1]):
        try:
            wanted = _worst(so_far, points, batch, options, threads)[: count - done]
            solved = solve_snapshots(
                problem,
                wanted,
                options=options,
                threads=threads,
                progress=batch_progress,
                checkpoint=batch_checkpoint(checkpoint, done, problem, wanted, options),
                executor=executor,
                known=so_far.snapshots,
            )
            so_far.add(solved)
            done += len(solved)
            if batch_progress:
                batch_progress.finish_batch(so_far.held_out_error)
        except KeyboardInterrupt as stop:
            raise Interrupted(_interruption(done, count, stop)) from None
        error = so_far.held_out_error
        if target is not None and error is not None and error < target:
            break
    return so_far.result()


def _check(
    problem: PosingProblem | InterpolationProblem, known: Snapshots | None, **numbers: int
) -> None:
    for name, value in numbers.items():
        require_count("greedy_snapshots", name, value, at_least=1)
    if known is not None:
        check_snapshots_of(problem, known, "greedy_snapshots", "known")


def _sizes(count: int, batch: int, candidates: int, *, chosen: bool) -> list[int]:
    """How many points of the sequence each batch chooses from; the first batch may use all."""
    batches = -(-count // batch)
    return [batch if k == 0 and not chosen else candidates * batch for k in range(batches)]


def _worst(
    so_far: SolvedSoFar,
    points: FloatArray,
    batch: int,
    options: SolverOptions,
    threads: int | None,
) -> FloatArray:
    """The points (batch, p) where the model's estimated errors are largest, and differ."""
    if len(points) <= batch or not so_far.enough:
        return points[:batch]
    problem = so_far.problem
    model = so_far.model(threads=threads)
    single = options.resolved(problem).single
    errors = SnapshotGram(problem.mass())
    errors.add(list(estimated_errors(model, points, single=single, threads=threads)))
    return points[largest_pivots(errors.matrix, batch)]


def _interruption(done: int, count: int, stop: KeyboardInterrupt) -> str:
    within = f"; of the next batch {stop}" if isinstance(stop, Interrupted) else ""
    return f"{done} of {count} samples are in finished batches{within}"
