"""How the error of a frame grows with its residual: faster than linearly."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Numbers = TypeVar("Numbers", float, FloatArray)

#: The exponent of a linear problem, and its weight: that of samples whose logarithms of residuals
#: have this sum of squares.
LINEAR, LINEAR_SPREAD = 1.0, 6.0
#: Limits of an exponent.
EXPONENTS = (1.0, 3.0)
#: Displacements below this share of those of the calibration count as rest.
REST = 1e-3


def growth_exponent(residuals: FloatArray, distances: FloatArray, sizes: FloatArray) -> float:
    """The exponent p of distance / size ~ (residual / size)^p, from calibration samples.

    Where a body is soft, for instance near buckling, the same forces move it farther, and the
    residual is larger as well. So the error grows faster than in proportion to the residual. The
    exponent is the slope of the least-squares line through the logarithms, shrunk towards 1 (ridge
    regression), since 16 samples alone do not determine it.

    Parameters
    ----------
    residuals, distances : (k,)
        Sampled residuals and true distances of the frames.
    sizes : (k,)
        Distances of the frames from tau, in the same unit. Frames at rest have no effect.

    Returns
    -------
    float
        Between 1 and 3; 1 without usable samples. It does not depend on the units.
    """
    moved = (residuals > 0) & (distances > 0) & (sizes > 0)
    if not moved.any():
        return LINEAR
    x, y = (np.log(some[moved] / sizes[moved]) for some in (residuals, distances))
    x, y = x - x.mean(), y - y.mean()
    fitted = (x @ y + LINEAR_SPREAD * LINEAR) / (x @ x + LINEAR_SPREAD)
    return float(np.clip(fitted, *EXPONENTS))


def rest_size(coordinates: FloatArray, mass: float) -> float:
    """The size below which frames count as at rest: a thousandth of the calibration's sizes."""
    typical = float(np.sqrt((coordinates**2).sum(axis=1).mean() / mass))
    return max(REST * typical, float(np.finfo(np.float64).tiny))


def grown(residual: Numbers, size: Numbers, exponent: float) -> Numbers:
    """size (residual / size)^p, the quick indicator: its ratios to true distances are calibrated.

    The size is at least that of `rest_size`.
    """
    found: Numbers = size * (residual / size) ** exponent
    return found
