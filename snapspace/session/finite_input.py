"""finite, radians: checks of a user's numbers."""

from __future__ import annotations

import math
import sys
import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_PACKAGE = __name__.partition(".")[0]


def finite(values: ArrayLike, shape: tuple[int, ...], name: str) -> FloatArray:
    """The values as an array; ValueError for another shape or, with its index, a bad entry."""
    array = _numbers(values)
    if array is None or array.shape != shape:
        numbers = "three numbers" if shape == (3,) else f"a {shape} matrix"
        raise ValueError(f"{name} needs {numbers}, got {values!r}".replace("\n", ""))
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        place = tuple(int(i) for i in bad[0])
        entry = ", ".join(map(str, place))
        raise ValueError(f"{name} has [{entry}] = {array[place]}, but it must be finite")
    return array


def _numbers(values: ArrayLike) -> FloatArray | None:
    """The values as an array, None for text, rows of unequal lengths and other objects."""
    try:
        return np.asarray(values, np.float64)
    except (TypeError, ValueError):
        return None


def radians(euler: ArrayLike, name: str) -> FloatArray:
    """Three finite angles, (3,); a UserWarning for more than a full turn: probably degrees."""
    angles = finite(euler, (3,), name)
    largest = float(np.abs(angles).max())
    if largest > 2.0 * math.pi:
        warnings.warn(
            f"{name} has an angle of {largest:g} radians, more than a full turn; convert degrees "
            "with np.deg2rad(...)",
            UserWarning,
            stacklevel=_outside(),
        )
    return angles


def _outside() -> int:
    """The `stacklevel` of the first caller outside this package."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_globals["__name__"].startswith(f"{_PACKAGE}."):
        frame, level = frame.f_back, level + 1
    return level
