"""Where a solve starts after a jump: a guess from the solutions that a model was trained with."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .motion_space import MotionSpace

FloatArray = NDArray[np.float64]

#: Added to the interpolation matrix, relative to its size: repeated samples do no harm.
_NUGGET = 1e-9


class SampleStarts:
    """Reduced coordinates interpolated between the samples of a posing model.

    Radial basis functions -r with a constant, over the handles' motions.

    Parameters
    ----------
    motions : MotionSpace
    coordinates : (k, d)
        Of its samples.
    """

    def __init__(self, motions: MotionSpace, coordinates: FloatArray) -> None:
        self._motions = motions
        self._coordinates = coordinates

    @cached_property
    def _weights(self) -> FloatArray:
        """Of the functions and the constant, (samples + 1, d). A drag without jumps needs none."""
        distances, k = self._motions.distances, len(self._coordinates)
        matrix = np.ones((k + 1, k + 1))
        matrix[:k, :k] = _NUGGET * distances.max() * np.eye(k) - distances
        matrix[k, k] = 0.0
        right = np.vstack([self._coordinates, np.zeros((1, self._coordinates.shape[1]))])
        return np.asarray(np.linalg.solve(matrix, right), np.float64)

    def __call__(self, offsets: FloatArray) -> FloatArray:
        """Coordinates (d,) for offsets (h, 3, 4)."""
        q: FloatArray = self._weights[-1] - self._motions.to_samples(offsets) @ self._weights[:-1]
        return q

    def after_jump(self, offsets: FloatArray, loop: Any) -> tuple[str, FloatArray]:
        """Name and coordinates (d,) to solve from: interpolated, or the loop's if that is lower.

        From rest alone a jump may end in a higher minimum, also with stable neo-Hookean: of 20
        poses of the Elephant one does. More starts, such as the nearest samples, find nothing lower
        with it, and with St.Venant-Kirchhoff lower energies that are no nearer to the full
        solutions; see docs/notes/closure-and-starts.md.
        """
        first = self(offsets)[: loop.dimension]
        present, known = (loop.value_and_gradient(q)[0] for q in (loop.q, first))
        lower = not present <= known and np.isfinite(known)
        return ("sample", first) if lower else ("last frame", loop.q)
