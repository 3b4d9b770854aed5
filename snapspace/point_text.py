"""corner_texts: corners of a box with enough digits to show its size."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

#: Digits of coordinates that are no longer than the box.
_DIGITS = 4
#: The largest number of digits of a double.
_MOST = 16


def corner_texts(low: ArrayLike, high: ArrayLike) -> tuple[str, str]:
    """Two corners (3,) of a box, as "(x, y, z)"; far from the origin they have more digits.

    With four digits, a body of length 3 at 200,000 would have the same number on both sides.
    """
    corners = np.array([low, high], np.float64)
    diagonal, farthest = np.linalg.norm(corners[1] - corners[0]), np.abs(corners).max()
    more = math.ceil(math.log10(farthest / diagonal)) if 0 < diagonal < farthest else 0
    digits = min(_DIGITS + more, _MOST)
    first, second = ("(" + ", ".join(f"{x:.{digits}g}" for x in row) + ")" for row in corners)
    return first, second
