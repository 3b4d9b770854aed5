"""The background behind the shape, and the conversion of light to bytes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .color import checked_color, to_linear, to_srgb

_TOP = np.array((0.965, 0.963, 0.957))
_BOTTOM = np.array((0.895, 0.889, 0.880))
_SHOULDER = 0.72


def backdrop(
    width: int, height: int, background: Sequence[float] | None = None
) -> NDArray[np.float64]:
    """Linear light (height, width, 3): a studio's paper roll, or one sRGB colour in 0..1."""
    if background is not None:
        color = to_linear(checked_color(background, who="render: background"))
        return np.tile(color, (height, width, 1))
    y = ((np.arange(height) + 0.5) / height)[:, None]
    x = ((np.arange(width) + 0.5) / width)[None, :]
    # Bright behind the shape, falling off softly to the corners and towards the viewer.
    away = ((x - 0.5) / 0.75) ** 2 + ((y - 0.42) / 0.80) ** 2
    fall = np.clip(0.55 * away + 0.45 * y * y, 0.0, 1.0)[:, :, None]
    return to_linear(_TOP + (_BOTTOM - _TOP) * fall)


def tone(light: NDArray[np.floating]) -> NDArray[np.floating]:
    """Compress highlights into 0..1: the identity below a shoulder, smooth beyond it."""
    headroom = 1.0 - _SHOULDER
    return np.where(
        light <= _SHOULDER,
        light,
        1.0 - headroom * np.exp(-(np.maximum(light, _SHOULDER) - _SHOULDER) / headroom),
    )


def to_bytes(light: NDArray[np.float64]) -> NDArray[np.uint8]:
    """sRGB bytes of linear light."""
    return np.rint(to_srgb(light) * 255.0).astype(np.uint8)
