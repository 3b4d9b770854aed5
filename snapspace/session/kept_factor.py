"""KeptFactor: L-BFGS from the Cholesky factor of an earlier Hessian."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve

FloatArray = NDArray[np.float64]
Factor = tuple[FloatArray, bool]

#: Steps that are remembered. A step costs 4 d multiplications an iteration, a gradient 6 n d.
MEMORY = 40
#: Least cosine of a step and the change of its gradient; less would ruin the approximation.
LEAST_CURVATURE = 1e-8


class KeptFactor:
    """An approximation of the inverse Hessian: that of an earlier point, corrected by L-BFGS.

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
        """Takes a step (d,) and the change of the gradient along it, if it curves upwards."""
        curvature = float(step @ change)
        if curvature > LEAST_CURVATURE * float(np.linalg.norm(step) * np.linalg.norm(change)):
            self._pairs.append((step, change, curvature))
