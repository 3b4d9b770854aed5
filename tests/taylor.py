"""Taylor tests: the order at which a remainder decreases with the step."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

#: Small enough for the leading term to dominate, large enough to stay clear of rounding.
STEPS = tuple(1e-2 * 0.5**k for k in range(5))


def observed_order(
    remainder: Callable[[float], float | NDArray[np.float64]], steps: Sequence[float] = STEPS
) -> float:
    """Slope of log |remainder(step)| over log step."""
    sizes = [float(np.linalg.norm(remainder(step))) for step in steps]
    assert min(sizes) > 0.0, "the remainder vanishes, so it has no order"
    return float(np.polyfit(np.log(steps), np.log(sizes), 1)[0])
