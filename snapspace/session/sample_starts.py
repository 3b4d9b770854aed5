"""SampleStarts: starting points after a jump, interpolated from the training solutions."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .motion_space import MotionSpace

FloatArray = NDArray[np.float64]

#: Added to the diagonal of the interpolation matrix, relative to its size, so that repeated
#: samples do no harm.
_NUGGET = 1e-9


class SampleStarts:
    """Reduced coordinates interpolated between the samples of a posing model.

    Radial basis functions -r with a constant, over the handles' motions.

    Parameters
    ----------
    motions : MotionSpace
    coordinates : (k, d)
        Reduced coordinates of its samples.
    """

    def __init__(self, motions: MotionSpace, coordinates: FloatArray) -> None:
        self._motions = motions
        self._coordinates = coordinates

    @cached_property
    def _weights(self) -> FloatArray:
        """Weights of the functions and the constant, (k + 1, d); computed at the first jump."""
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
        """Name and coordinates (d,) of the start: interpolated, or the loop's if lower in energy.

        From rest alone a jump may end in a higher minimum, even with stable neo-Hookean: one of 20
        poses of the Elephant does. More starts, such as the nearest samples, find nothing lower
        with that material. With St.Venant-Kirchhoff they find lower energies that are no closer to
        the full solutions; see docs/notes/closure-and-starts.md.
        """
        guess = self(offsets)[: loop.dimension]
        current, guessed = (loop.value_and_gradient(q)[0] for q in (loop.q, guess))
        lower = not current <= guessed and np.isfinite(guessed)
        return ("sample", guess) if lower else ("last frame", loop.q)
