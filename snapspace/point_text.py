"""corner_texts, point_text: points in so many digits that the body has a size."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Digits of coordinates that are no larger than the body.
_DIGITS = 4
#: The largest number of digits of a double.
_MOST = 16


def corner_texts(low: ArrayLike, high: ArrayLike) -> tuple[str, str]:
    """Two corners (3,) of a box, as "(x, y, z)"; far from the origin they have more digits.

    With four digits, a body of length 3 at 200,000 would have the same number on both sides.
    """
    corners = np.array([low, high], np.float64)
    digits = _digits(float(np.abs(corners).max()), float(np.linalg.norm(corners[1] - corners[0])))
    return _text(corners[0], digits), _text(corners[1], digits)


def point_text(point: ArrayLike, diagonal: float) -> str:
    """A point (3,) of a body with this diagonal, with as many digits as `corner_texts`."""
    x = np.asarray(point, np.float64)
    return _text(x, _digits(float(np.abs(x).max()), diagonal))


def _digits(farthest: float, diagonal: float) -> int:
    more = math.ceil(math.log10(farthest / diagonal)) if 0 < diagonal < farthest else 0
    return min(_DIGITS + more, _MOST)


def _text(point: NDArray[np.float64], digits: int) -> str:
    return "(" + ", ".join(f"{x:.{digits}g}" for x in point) + ")"
