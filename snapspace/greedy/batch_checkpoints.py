"""Checkpoints of a run in batches: one folder per batch, in the folder of the run."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import Problem
from ..snapshots import Checkpoint, SolverOptions, run_key, solver_key

FloatArray = NDArray[np.float64]


def batch_checkpoint(
    whole: Checkpoint | None,
    begin: int,
    problem: Problem,
    parameters: FloatArray,
    options: SolverOptions,
) -> Checkpoint | None:
    """The checkpoint of the batch that begins with sample `begin`; None if the run has none.

    The folder's name contains a key of the batch. So a batch that was chosen differently, for
    instance on another processor, does not use these samples.
    """
    if whole is None:
        return None
    key = run_key(problem, parameters, solver_key(options, problem))
    return Checkpoint(whole.folder / f"batch-{begin:05d}-{key}")


def greedy_key(
    problem: Problem, options: SolverOptions, *, seed: int, batch: int, candidates: int
) -> str:
    """Hash of everything that the choice of samples depends on, 16 hex digits.

    The number of samples and the target are not part of the hash, so a run for more samples
    continues from the batches of a shorter one.
    """
    choice = {"seed": seed, "batch": batch, "candidates": candidates}
    solver = solver_key(options, problem)
    return run_key(problem, np.zeros((0, problem.parameter_count)), {**solver, "greedy": choice})


def finished_samples(whole: Checkpoint) -> int:
    """Number of saved samples in all batches."""
    return sum(len(Checkpoint(batch).numbers()) for batch in whole.folder.glob("batch-*"))
