"""MotionSpace: motions of the handles as points, with the training samples."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..reduction import PosingModel

FloatArray = NDArray[np.float64]

#: In units of the samples' spacing. Motions farther from all samples are not interpolated.
FARTHEST = 1e3


class MotionSpace:
    """The offsets D_h of the moving handles in the metric of the handle energy.

    The distance between two motions does not depend on their parametrisation. Its square is the
    handle energy of one motion at a shape that follows the other.

    Parameters
    ----------
    model : PosingModel
        A model with at least two samples.
    """

    def __init__(self, model: PosingModel) -> None:
        # S = R^T R, so that tr(D S D^T) = |D R^T|^2; S is singular for flat handles
        values, vectors = np.linalg.eigh(model.handles.S[1:])
        roots = np.sqrt(np.maximum(values, 0.0))
        self._metric = vectors * roots[:, None, :]
        #: Points of the samples, (k, f).
        self.samples = np.array(
            [self.point(model.problem.offsets(w)) for w in model.training_parameters]
        )

    @cached_property
    def distances(self) -> FloatArray:
        """Distances between all samples, (k, k)."""
        return distances(self.samples, self.samples)

    @cached_property
    def spacing(self) -> float:
        """Median distance of the samples to their nearest neighbours."""
        return float(np.median(np.sort(self.distances, axis=1)[:, 1]))

    def point(self, offsets: FloatArray) -> FloatArray:
        """The point (f,) of offsets (h, 3, 4)."""
        point: FloatArray = (offsets[1:] @ self._metric).reshape(-1)
        return point

    def to_samples(self, offsets: FloatArray) -> FloatArray:
        """Distances from offsets (h, 3, 4) to all samples, (k,)."""
        found: FloatArray = distances(self.point(offsets)[None], self.samples)[0]
        return found

    def distance(self, offsets: FloatArray, others: FloatArray) -> float:
        """Distance between two settings of the handles, (h, 3, 4) each."""
        return float(np.linalg.norm(self.point(offsets) - self.point(others)))

    def is_jump(self, offsets: FloatArray, before: FloatArray) -> bool:
        """Whether a motion is longer than the samples' spacing, and ends near enough to them."""
        with np.errstate(over="ignore", invalid="ignore"):  # motions far beyond any use
            if self.distance(offsets, before) <= self.spacing:
                return False
            return bool(self.to_samples(offsets).min() < FARTHEST * self.spacing)


def distances(a: FloatArray, b: FloatArray) -> FloatArray:
    """Euclidean distances between the rows of a and of b, (len(a), len(b))."""
    squares = (a**2).sum(axis=1)[:, None] + (b**2).sum(axis=1) - 2.0 * a @ b.T
    distances: FloatArray = np.sqrt(np.maximum(squares, 0.0))
    return distances
