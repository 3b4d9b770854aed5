"""BlendedElements: the blended energy of several poses as a sum over a few elements."""

from __future__ import annotations

from abc import ABC
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core

FloatArray = NDArray[np.float64]


class BlendedElements(ABC):
    """Base of the blended sums over tets, over a shell's elements and over stars."""

    _core: core.BlendedFunction

    def at(self, weights: ArrayLike) -> WeightedCubature:
        """The blended energy for weights (poses,)."""
        return WeightedCubature(self, np.asarray(weights, np.float64))

    def value_and_gradient(self, q: ArrayLike, weights: FloatArray) -> tuple[float, FloatArray]:
        """Energy at q (d,) for weights (poses,), and its gradient (d,)."""
        self._core.set_weights(weights)
        value, gradient = self._core.value_and_gradient(np.asarray(q, np.float64))
        return value, gradient

    def hessian(self, q: ArrayLike, weights: FloatArray) -> FloatArray:
        """Hessian at q, (d, d)."""
        self._core.set_weights(weights)
        hessian: FloatArray = self._core.derivatives(np.asarray(q, np.float64))[2]
        return hessian

    def stresses(self, q: ArrayLike, weights: FloatArray) -> NDArray[np.float32]:
        """Derivatives of the elements' energies by their nine numbers."""
        self._core.set_weights(weights)
        stresses: NDArray[np.float32] = self._core.stresses(np.asarray(q, np.float64))
        return stresses

    def curvatures(self, q: ArrayLike, weights: FloatArray) -> NDArray[np.float32]:
        """Hessians of the elements by their nine numbers."""
        self._core.set_weights(weights)
        curvatures: NDArray[np.float32] = self._core.curvatures(np.asarray(q, np.float64))
        return curvatures


@dataclass(frozen=True)
class WeightedCubature:
    """A blended energy for some weights (poses,), as a function of q alone."""

    cubature: BlendedElements
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
