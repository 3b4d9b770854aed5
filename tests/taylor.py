"""Taylor tests: the order at which a remainder decreases with the step."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from snapspace import ElasticEnergy

FloatArray = NDArray[np.float64]

#: Small enough for the leading term to dominate, large enough to stay clear of rounding.
STEPS = tuple(1e-2 * 0.5**k for k in range(5))


def observed_order(
    remainder: Callable[[float], float | FloatArray], steps: Sequence[float] = STEPS
) -> float:
    """Slope of log |remainder(step)| over log step."""
    sizes = [float(np.linalg.norm(remainder(step))) for step in steps]
    assert min(sizes) > 0.0, "the remainder vanishes, so it has no order"
    return float(np.polyfit(np.log(steps), np.log(sizes), 1)[0])


def value_order(energy: ElasticEnergy, x: FloatArray, d: FloatArray) -> float:
    """Order of the value along d minus its linear model: two if the gradient is right."""
    value, gradient = energy.value_and_gradient(x)
    assert np.linalg.norm(gradient) > 0
    return observed_order(lambda h: energy.value(x + h * d) - value - h * (gradient @ d))


def gradient_order(energy: ElasticEnergy, x: FloatArray, d: FloatArray) -> float:
    """Order of the gradient along d minus its linear model: two if the Hessian is right."""
    gradient, product = energy.value_and_gradient(x)[1], energy.hessian_product(x, d)
    assert np.linalg.norm(product) > 0
    return observed_order(
        lambda h: energy.value_and_gradient(x + h * d)[1] - gradient - h * product
    )
