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

#: Dimension of the models that choose samples. Coefficients cost d^4: on the Dragon, at 20, as much
#: as a dozen samples.
MODEL_DIMENSION = 20
#: Eigenvalues of the Gram matrix below this share of the largest are not worth a dimension: a path
#: between two poses has only some directions.
_NEGLIGIBLE = 1e-8


class SolvedSoFar:
    """What is solved, and what follows from it.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    known : Snapshots, optional
        Of the problem; they count as solved. Those that are not usable do not.
    dimension : int
        Of the subspaces whose error is estimated.
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
        """What is known and then what is solved; there must be some."""
        assert self.snapshots is not None
        return self.snapshots

    def add(self, batch: Snapshots) -> None:
        """Adds a batch, after its error against everything before was noted."""
        self._append(batch)
        self.held_out_error = self._errors.of_last(self.all.usable, len(batch))

    @property
    def enough(self) -> bool:
        """Whether there are as many samples as the energy of a model asks for."""
        fewest = fewest_snapshots(self.problem, MODEL_DIMENSION)
        return int(self.all.usable.sum()) >= fewest

    def model(self, *, threads: int | None) -> PosingModel | InterpolationModel:
        """A small reduced model of it; ValueError if no sample is usable."""
        everything = self.all
        dimension = min(MODEL_DIMENSION, max(1, self._directions() // 2))
        subspace = snapshot_pca(everything, dimension=dimension, gram=self._errors.gram)
        used = everything.select(everything.usable)
        return reduce(self.problem, subspace, snapshots=used, threads=threads)

    def result(self) -> Snapshots:
        """The solved samples, without what was known before."""
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
        """How many directions the usable samples have that are more than negligible."""
        usable = np.flatnonzero(self.all.usable)
        eigenvalues = np.linalg.eigvalsh(self._errors.gram.matrix[np.ix_(usable, usable)])
        return int((eigenvalues > _NEGLIGIBLE * eigenvalues.max(initial=0.0)).sum())
