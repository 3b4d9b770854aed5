"""WeightedCubature: the blended energy for some weights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


class BlendedFunction(Protocol):
    """The blended energy of several poses, a function of q and of weights."""

    def value_and_gradient(self, q: ArrayLike, weights: FloatArray) -> tuple[float, FloatArray]:
        """Energy at q (d,) for weights (poses,), and its gradient (d,)."""
        ...

    def hessian(self, q: ArrayLike, weights: FloatArray) -> FloatArray:
        """Hessian at q, (d, d)."""
        ...


@dataclass(frozen=True)
class WeightedCubature:
    """A blended energy for some weights (poses,), as a function of q alone."""

    cubature: BlendedFunction
    weights: FloatArray

    def value(self, q: ArrayLike) -> float:
        """Energy at q (d,)."""
        return self.value_and_gradient(q)[0]

    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at q and its gradient (d,)."""
        return self.cubature.value_and_gradient(q, self.weights)

    def hessian(self, q: ArrayLike) -> FloatArray:
        """Hessian at q, (d, d)."""
        return self.cubature.hessian(q, self.weights)
