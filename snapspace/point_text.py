"""corner_texts, point_text: points in so many digits that the body has a size."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Digits of coordinates that are no larger than the body.
_DIGITS = 4
#: The largest number of digits of a double.
_MOST = 16
#: Coordinates below this share of the body's diagonal are rounding errors of zero.
_ZERO = 1e-9


def corner_texts(low: ArrayLike, high: ArrayLike) -> tuple[str, str]:
    """Two corners (3,) of a box, as "(x, y, z)"; far from the origin they have more digits.

    With four digits, a body of length 3 at 200,000 would have the same number on both sides.
    """
    corners = np.array([low, high], np.float64)
    diagonal = float(np.linalg.norm(corners[1] - corners[0]))
    farthest = float(np.abs(corners).max())
    return _text(corners[0], farthest, diagonal), _text(corners[1], farthest, diagonal)


def point_text(point: ArrayLike, diagonal: float) -> str:
    """A point (3,) of a body with this diagonal, with as many digits as `corner_texts`."""
    x = np.asarray(point, np.float64)
    return _text(x, float(np.abs(x).max()), diagonal)


def _text(point: NDArray[np.float64], farthest: float, diagonal: float) -> str:
    more = math.ceil(math.log10(farthest / diagonal)) if 0 < diagonal < farthest else 0
    digits = min(_DIGITS + more, _MOST)
    near_zero = np.abs(point) < _ZERO * diagonal
    return "(" + ", ".join(f"{x:.{digits}g}" for x in np.where(near_zero, 0.0, point)) + ")"
