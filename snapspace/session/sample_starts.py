"""Where a solve starts after a jump: a guess from the solutions that a model was trained with."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..reduction import PosingModel

FloatArray = NDArray[np.float64]

#: Added to the interpolation matrix, relative to its size: repeated samples do no harm.
_NUGGET = 1e-9


class SampleStarts:
    """Reduced coordinates interpolated between the samples of a posing model.

    Radial basis functions -r with a constant, over the offsets D_h of the moving handles in the
    metric of the handles' energy: the distance of two motions is how far they move the handles
    apart, whatever parameters describe them. On the Dragon (d = 120, 960 tets, 30 unseen poses)
    solves that start here end 0.018 / 0.029 (median / mean) from the full solutions, from the
    nearest sample 0.022 / 0.028, from rest 0.025 / 0.041.

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
        offsets = [model.problem.offsets(w) for w in model.training_parameters]
        self._samples = np.array([self._features(o) for o in offsets])
        self._distances = _distances(self._samples, self._samples)
        self._coordinates = model.training_coordinates
        #: How far samples are from their nearest neighbour, in the median.
        self.spacing = float(np.median(np.sort(self._distances, axis=1)[:, 1]))

    @cached_property
    def _weights(self) -> FloatArray:
        """Of the functions and the constant, (samples + 1, d). A drag without jumps needs none."""
        distances, k = self._distances, len(self._distances)
        matrix = np.ones((k + 1, k + 1))
        matrix[:k, :k] = _NUGGET * distances.max() * np.eye(k) - distances
        matrix[k, k] = 0.0
        right = np.vstack([self._coordinates, np.zeros((1, self._coordinates.shape[1]))])
        return np.asarray(np.linalg.solve(matrix, right), np.float64)

    def __call__(self, offsets: FloatArray) -> FloatArray:
        """Coordinates (d,) for offsets (h, 3, 4)."""
        distances = _distances(self._features(offsets)[None], self._samples)[0]
        q: FloatArray = self._weights[-1] - distances @ self._weights[:-1]
        return q

    def distance(self, offsets: FloatArray, others: FloatArray) -> float:
        """How far two settings of the handles (h, 3, 4) are apart, in the unit of `spacing`."""
        return float(np.linalg.norm(self._features(offsets) - self._features(others)))

    def _features(self, offsets: FloatArray) -> FloatArray:
        features: FloatArray = (offsets[1:] @ self._metric).reshape(-1)
        return features


def _distances(a: FloatArray, b: FloatArray) -> FloatArray:
    """Euclidean distances of rows, (len(a), len(b))."""
    squares = (a**2).sum(axis=1)[:, None] + (b**2).sum(axis=1) - 2.0 * a @ b.T
    distances: FloatArray = np.sqrt(np.maximum(squares, 0.0))
    return distances
