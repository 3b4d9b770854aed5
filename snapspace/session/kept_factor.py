"""KeptFactor: L-BFGS from the Cholesky factor of an earlier Hessian."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve

FloatArray = NDArray[np.float64]
Factor = tuple[FloatArray, bool]

#: Number of stored steps. A step costs 4 d multiplications per iteration, a gradient 6 n d.
MEMORY = 40
#: Smallest cosine between a step and the change of the gradient; smaller ones would ruin the
#: approximation.
LEAST_CURVATURE = 1e-8


class KeptFactor:
    """An approximate inverse Hessian: that of an earlier point, corrected by L-BFGS.

    Where a Hessian costs as much as a hundred gradients, it pays to factor few of them (Nocedal &
    Wright, 7.2: the factor takes the place of the scaled identity).

    Parameters
    ----------
    factor : from `scipy.linalg.cho_factor`, of a positive definite Hessian (d, d)
    """

    def __init__(self, factor: Factor) -> None:
        self._factor = factor
        self._pairs: deque[tuple[FloatArray, FloatArray, float]] = deque(maxlen=MEMORY)

    def direction(self, gradient: FloatArray) -> FloatArray:
        """-H^-1 gradient, (d,), a direction of descent."""
        right = gradient.copy()
        shares = []
        for step, change, curvature in reversed(self._pairs):
            share = float(step @ right) / curvature
            right -= share * change
            shares.append(share)
        found = np.asarray(cho_solve(self._factor, right), np.float64)
        for (step, change, curvature), share in zip(self._pairs, reversed(shares), strict=True):
            found += (share - float(change @ found) / curvature) * step
        return -found

    def learn(self, step: FloatArray, change: FloatArray) -> None:
        """Stores a step (d,) and the gradient's change along it, if the curvature is positive."""
        curvature = float(step @ change)
        if curvature > LEAST_CURVATURE * float(np.linalg.norm(step) * np.linalg.norm(change)):
            self._pairs.append((step, change, curvature))
