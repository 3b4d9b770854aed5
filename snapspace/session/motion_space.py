"""MotionSpace: motions of the handles as points, and the samples among them."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..reduction import PosingModel

FloatArray = NDArray[np.float64]


class MotionSpace:
    """The offsets D_h of the moving handles in the metric of the handles' energy.

    The distance of two motions is how far they move the handles apart, whatever parameters describe
    them: its square is the handles' energy of the one where the shape follows the other.

    Parameters
    ----------
    model : PosingModel
        With at least two samples.
    """

    def __init__(self, model: PosingModel) -> None:
        # S = R^T R, so that tr(D S D^T) = |D R^T|^2; S is singular for flat handles
        values, vectors = np.linalg.eigh(model.handles.S[1:])
        roots = np.sqrt(np.maximum(values, 0.0))
        self._metric = vectors * roots[:, None, :]
        #: Of the samples, (k, f).
        self.samples = np.array(
            [self.point(model.problem.offsets(w)) for w in model.training_parameters]
        )

    @cached_property
    def distances(self) -> FloatArray:
        """Between all samples, (k, k)."""
        return distances(self.samples, self.samples)

    @cached_property
    def spacing(self) -> float:
        """How far samples are from their nearest neighbour, in the median."""
        return float(np.median(np.sort(self.distances, axis=1)[:, 1]))

    def point(self, offsets: FloatArray) -> FloatArray:
        """Of offsets (h, 3, 4), (f,)."""
        point: FloatArray = (offsets[1:] @ self._metric).reshape(-1)
        return point

    def to_samples(self, offsets: FloatArray) -> FloatArray:
        """Distances of offsets (h, 3, 4) to all samples, (k,)."""
        found: FloatArray = distances(self.point(offsets)[None], self.samples)[0]
        return found

    def distance(self, offsets: FloatArray, others: FloatArray) -> float:
        """How far two settings of the handles (h, 3, 4) are apart."""
        return float(np.linalg.norm(self.point(offsets) - self.point(others)))


def distances(a: FloatArray, b: FloatArray) -> FloatArray:
    """Euclidean distances of rows, (len(a), len(b))."""
    squares = (a**2).sum(axis=1)[:, None] + (b**2).sum(axis=1) - 2.0 * a @ b.T
    distances: FloatArray = np.sqrt(np.maximum(squares, 0.0))
    return distances
