"""SolvedSoFar: the samples of all batches, their errors, and a model of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel, fewest_snapshots, reduce
from ..snapshots import Snapshots
from ..snapshots.held_out import HeldOutError
from ..subspace import snapshot_pca

FloatArray = NDArray[np.float64]

#: Dimension of the models that choose samples. Computing coefficients costs d^4: on the Dragon with
#: d = 20, as much as a dozen samples.
MODEL_DIMENSION = 20
#: Eigenvalues of the Gram matrix below this share of the largest do not count as directions, since
#: a path between two poses has only a few.
_NEGLIGIBLE = 1e-8


class SolvedSoFar:
    """The solved samples, with their errors and a reduced model.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
        The problem that is sampled.
    known : Snapshots, optional
        Samples of the problem that count as solved, if they are usable.
    dimension : int
        Dimension of the subspaces whose error is estimated.
    """

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        known: Snapshots | None,
        dimension: int,
    ) -> None:
        self.problem = problem
        self.known = 0
        self.snapshots: Snapshots | None = None
        self.held_out_error: float | None = None
        self._errors = HeldOutError(problem, dimension=dimension)
        if known is not None and known.usable.any():
            self._append(known.select(known.usable))
            self.known = len(self.all)

    @property
    def all(self) -> Snapshots:
        """The known samples, then the solved ones; there must be some."""
        assert self.snapshots is not None
        return self.snapshots

    def add(self, batch: Snapshots) -> None:
        """Adds a batch, and sets `held_out_error` to its error given all earlier samples."""
        self._append(batch)
        self.held_out_error = self._errors.of_last(self.all.usable, len(batch))

    @property
    def enough(self) -> bool:
        """Whether there are enough samples for the energy of a model."""
        fewest = fewest_snapshots(self.problem, MODEL_DIMENSION)
        return int(self.all.usable.sum()) >= fewest

    def model(self, *, threads: int | None) -> PosingModel | InterpolationModel:
        """A small reduced model of all samples; ValueError if none is usable."""
        everything = self.all
        dimension = min(MODEL_DIMENSION, max(1, self._directions() // 2))
        subspace = snapshot_pca(everything, dimension=dimension, gram=self._errors.gram)
        used = everything.select(everything.usable)
        return reduce(self.problem, subspace, snapshots=used, threads=threads)

    def result(self) -> Snapshots:
        """The solved samples, without the known ones."""
        everything, begin = self.all, self.known
        return Snapshots(
            self.problem,
            everything.parameters[begin:],
            everything.displacements[begin:],
            everything.reports[begin:],
            None if begin else self._errors.gram,
        )

    def _append(self, batch: Snapshots) -> None:
        self.snapshots = batch if self.snapshots is None else self.snapshots.joined(batch)
        self._errors.add(list(batch.displacements))

    def _directions(self) -> int:
        """Number of directions of the usable samples that are not negligible."""
        usable = np.flatnonzero(self.all.usable)
        eigenvalues = np.linalg.eigvalsh(self._errors.gram.matrix[np.ix_(usable, usable)])
        return int((eigenvalues > _NEGLIGIBLE * eigenvalues.max(initial=0.0)).sum())
