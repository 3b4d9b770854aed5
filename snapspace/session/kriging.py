"""Kriging: smooth functions through values at samples that are not exact."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .motion_space import distances

FloatArray = NDArray[np.float64]

#: Correlation length over the root mean square distance of the samples from their centre.
_LENGTH = 3.0
#: Directions in which the samples extend less than this, relative to the longest, are none.
_FLAT = 1e-6


class Kriging:
    """Functions of points: a linear trend, and deviations with a Matern covariance around it.

    Universal kriging (Cressie 1993, "Statistics for Spatial Data", sec. 3.4) with Matern's
    covariance of order 5/2. Far from all points the trend is left.

    Parameters
    ----------
    points : (k, f)
        More than f + 1.
    """

    def __init__(self, points: FloatArray) -> None:
        self._center = points.mean(axis=0)
        offsets = points - self._center
        _, extents, directions = np.linalg.svd(offsets, full_matrices=False)
        self._radius = float(np.sqrt((offsets**2).sum(axis=1).mean()))
        kept = extents > _FLAT * extents[0]
        self._directions = directions[kept].T / self._radius
        self._points, self._squares = points, (points**2).sum(axis=1)
        self._basis = np.array([self._trend(p) for p in points])

    @property
    def trend_size(self) -> int:
        """Coefficients of the trend."""
        return int(self._basis.shape[1])

    def fitted(self, values: FloatArray, nugget: FloatArray) -> FloatArray:
        """Weights (k + trend_size, m) for values (k, m).

        `nugget` (k,) is the variance of each value's error over that of the deviations.
        """
        k, t = self._basis.shape
        matrix = np.zeros((k + t, k + t))
        matrix[:k, :k] = self._covariance(distances(self._points, self._points)) + np.diag(nugget)
        matrix[:k, k:] = self._basis
        matrix[k:, :k] = self._basis.T
        right = np.vstack([values, np.zeros((t, values.shape[1]))])
        return np.asarray(np.linalg.solve(matrix, right), np.float64)

    def distances(self, point: FloatArray) -> FloatArray:
        """Of a point (f,) to the points, (k,)."""
        squares = self._squares + point @ point - 2.0 * (self._points @ point)
        return np.asarray(np.sqrt(np.maximum(squares, 0.0)), np.float64)

    def row(self, point: FloatArray, distances: FloatArray) -> FloatArray:
        """What weights are multiplied with at a point (f,) with these distances: (k + t,)."""
        return np.concatenate([self._covariance(distances), self._trend(point)])

    def _trend(self, point: FloatArray) -> FloatArray:
        return np.append((point - self._center) @ self._directions, 1.0)

    def _covariance(self, distances: FloatArray) -> FloatArray:
        scaled = (np.sqrt(5.0) / (_LENGTH * self._radius)) * distances
        covariance: FloatArray = (1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled)
        return covariance
