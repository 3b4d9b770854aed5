"""HeldOutError: estimates the current error of unseen samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..displacements import SnapshotGram
from ..problem import Problem, solutions_beyond_tau

FloatArray = NDArray[np.float64]

#: Dimension of the subspaces in which errors are estimated, a usual size. While there are fewer
#: directions, all are used.
DIMENSION = 40


class HeldOutError:
    """Errors of each new block of samples in the best subspace of all samples before it.

    New samples are unseen until they are used: an unbiased estimate that costs only inner products,
    which the subspace needs anyway.

    gram : SnapshotGram of all samples so far

    Parameters
    ----------
    problem : Problem
    dimension : int, default 40
        Dimension of the subspaces.
    """

    def __init__(self, problem: Problem, *, dimension: int = DIMENSION) -> None:
        self.dimension = dimension
        self.gram = SnapshotGram.of(problem)
        self._known = solutions_beyond_tau(problem)[1] - problem.base

    def add(self, rows: Sequence[FloatArray], *, threads: int = 0) -> None:
        """Adds a block of displacements (3n,)."""
        self.gram.add(rows, threads=threads)

    def of_last(self, converged: NDArray[np.bool_], last: int) -> float | None:
        """Median error of the last samples by all earlier ones; None if there are none.

        converged (k,) is a mask of the samples that count.
        """
        before = len(self.gram) - last
        training, unseen = np.flatnonzero(converged[:before]), np.flatnonzero(converged[before:])
        known = np.arange(len(self.gram), len(self.gram) + len(self._known))
        if len(unseen) == 0 or len(training) + len(known) == 0:
            return None
        gram = self.gram
        if len(known):
            gram = gram.copy()
            gram.add(list(self._known))
        training = np.append(training, known)
        size = min(self.dimension, len(training))
        return float(np.median(gram.held_out_error(training, unseen + before, size)))
