"""Colours for meshes: a small palette, tinted regions, and perceptually ordered colour maps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .color import checked_color, from_oklab, to_oklab

Color = tuple[float, float, float]

CLAY: Color = (0.84, 0.795, 0.735)
TERRACOTTA: Color = (0.80, 0.42, 0.29)
TEAL: Color = (0.16, 0.52, 0.53)
OCHRE: Color = (0.87, 0.65, 0.27)
PLUM: Color = (0.50, 0.30, 0.48)
SAGE: Color = (0.52, 0.64, 0.42)
SLATE: Color = (0.36, 0.45, 0.60)
ACCENTS: tuple[Color, ...] = (TEAL, TERRACOTTA, OCHRE, PLUM, SAGE, SLATE)

# Anchors at equal steps; lightness falls (diverging: falls to both sides) at an even pace.
_MAPS: dict[str, tuple[Color, ...]] = {
    "terracotta": ((0.94, 0.90, 0.84), (0.91, 0.68, 0.46), (0.78, 0.38, 0.27), (0.38, 0.13, 0.22)),
    "teal": ((0.94, 0.90, 0.84), (0.60, 0.78, 0.70), (0.16, 0.54, 0.56), (0.10, 0.24, 0.38)),
    "diverging": (
        (0.05, 0.33, 0.42),
        (0.42, 0.68, 0.66),
        (0.94, 0.91, 0.86),
        (0.90, 0.61, 0.43),
        (0.62, 0.23, 0.17),
    ),
}


def colormap(
    values: NDArray[Any] | Sequence[float],
    *,
    palette: str = "terracotta",
    limits: tuple[float, float] | None = None,
) -> NDArray[np.float64]:
    """Colours of a scalar field; equal steps of value are equal steps to the eye.

    The anchors of a palette are interpolated linearly in OKLab, so the lightness of "terracotta"
    and "teal" falls monotonically with the value, so the order survives a grey print.

    Parameters
    ----------
    values : array_like, (n,)
        One finite scalar per vertex, for instance a displacement or an error.
    palette : {"terracotta", "teal", "diverging"}
        "diverging" is lightest in the middle of the limits.
    limits : (low, high), optional
        Values at the two ends; beyond them colours are constant. By default the smallest and the
        largest value, and for "diverging" minus and plus the largest magnitude.

    Returns
    -------
    ndarray, (n, 3)
        sRGB in 0..1, as `render(colors=...)` takes it. A constant field gets the first colour
        (the middle one for "diverging").

    Raises
    ------
    ValueError
        If a value is not finite, the palette is unknown or the limits do not increase.
    """
    field = np.asarray(values, dtype=np.float64)
    if field.ndim != 1:
        raise ValueError(f"colormap: values has shape {field.shape}; give one scalar per vertex")
    if not np.all(np.isfinite(field)):
        wrong = int(np.flatnonzero(~np.isfinite(field))[0])
        raise ValueError(f"colormap: value {wrong} is {field[wrong]}; every value must be finite")
    if palette not in _MAPS:
        raise ValueError(f"colormap: no palette {palette!r}; choose one of {', '.join(_MAPS)}")
    low, high = _limits(field, palette, limits)

    anchors = to_oklab(_MAPS[palette])
    if high == low:
        place = np.full(len(field), 0.5 if palette == "diverging" else 0.0)
    else:
        place = np.clip((field - low) / (high - low), 0.0, 1.0)
    knots = np.linspace(0.0, 1.0, len(anchors))
    return from_oklab(np.column_stack([np.interp(place, knots, axis) for axis in anchors.T]))


def tint(
    vertex_count: int,
    regions: Sequence[NDArray[Any] | Sequence[int]],
    *,
    base: Sequence[float] = CLAY,
    accents: Sequence[Sequence[float]] = ACCENTS,
) -> NDArray[np.float64]:
    """Per-vertex colours of a mesh with some regions, such as its handles, tinted.

    Parameters
    ----------
    vertex_count : int
        Rows of the result.
    regions : sequence of (k,) int
        Vertex indices of each region; a later region covers an earlier one.
    base : (3,)
        sRGB in 0..1 of everything else.
    accents : sequence of (3,)
        sRGB in 0..1 of the regions, repeated when there are more regions.

    Returns
    -------
    ndarray, (vertex_count, 3)

    Raises
    ------
    ValueError
        If an index is out of range or a colour is not three values between 0 and 1.
    """
    colors = np.tile(checked_color(base, who="tint: base"), (vertex_count, 1))
    tones = [checked_color(accent, who=f"tint: accent {i}") for i, accent in enumerate(accents)]
    if not tones:
        raise ValueError("tint: accents is empty; give at least one colour")
    for number, region in enumerate(regions):
        index = np.asarray(region, dtype=np.int64)
        if index.size and (index.min() < 0 or index.max() >= vertex_count):
            wrong = index[(index < 0) | (index >= vertex_count)][0]
            raise ValueError(
                f"tint: region {number} has vertex index {wrong}, "
                f"but there are {vertex_count} vertices"
            )
        colors[index] = tones[number % len(tones)]
    return colors


def _limits(
    field: NDArray[np.float64], palette: str, limits: tuple[float, float] | None
) -> tuple[float, float]:
    if limits is not None:
        low, high = float(limits[0]), float(limits[1])
        if not (np.isfinite(low) and np.isfinite(high) and low < high):
            raise ValueError(f"colormap: limits are {limits}; give (low, high) with low < high")
        return low, high
    if field.size == 0:
        return 0.0, 0.0
    if palette == "diverging":
        reach = float(np.abs(field).max())
        return -reach, reach
    return float(field.min()), float(field.max())
