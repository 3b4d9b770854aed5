"""Colours: sRGB for input, linear light for computing, OKLab for perceptual mixing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Matrices of Björn Ottosson, "A perceptual color space for image processing", 2020.
_RGB_TO_LMS = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_LMS_TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def to_linear(srgb: Any) -> NDArray[np.float64]:
    """Linear light in 0..1 of sRGB values in 0..1 (IEC 61966-2-1)."""
    value = np.asarray(srgb, dtype=np.float64)
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def to_srgb(linear: Any) -> NDArray[np.float64]:
    """sRGB values in 0..1 of linear light; light out of 0..1 is clipped."""
    value = np.clip(np.asarray(linear, dtype=np.float64), 0.0, 1.0)
    return np.where(value <= 0.0031308, value * 12.92, 1.055 * value ** (1.0 / 2.4) - 0.055)


def to_oklab(srgb: Any) -> NDArray[np.float64]:
    """OKLab coordinates (..., 3) of sRGB colours (..., 3); the first is lightness in 0..1."""
    lab: NDArray[np.float64] = np.cbrt(to_linear(srgb) @ _RGB_TO_LMS.T) @ _LMS_TO_LAB.T
    return lab


def from_oklab(lab: Any) -> NDArray[np.float64]:
    """sRGB colours (..., 3) of OKLab coordinates; colours out of gamut are clipped."""
    lms = (np.asarray(lab, dtype=np.float64) @ np.linalg.inv(_LMS_TO_LAB).T) ** 3
    return to_srgb(lms @ np.linalg.inv(_RGB_TO_LMS).T)


def checked_color(color: Sequence[float] | NDArray[Any], *, who: str) -> NDArray[np.float64]:
    """One sRGB colour as (3,) floats, or ValueError whose message begins with `who`."""
    try:
        value = np.asarray(color, dtype=np.float64)
    except (TypeError, ValueError):
        value = np.empty(0)
    if value.shape != (3,) or not np.all((value >= 0.0) & (value <= 1.0)):
        raise ValueError(f"{who} is {color!r}; give three sRGB values between 0 and 1")
    return value
