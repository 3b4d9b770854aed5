"""A contact sheet: several shapes of one mesh, in one light, at one scale."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .backdrop import backdrop, to_bytes
from .caption import write_captions
from .checks import checked_samples, checked_size
from .exposure import Exposure
from .scene import Scene

# How far shadows reach beyond their cell, as shares of its width and height; they fade out there.
SPILL = (0.6, 0.25)


def render_row(
    shapes: Sequence[Any],
    faces: Any,
    *,
    labels: Sequence[str] | None = None,
    columns: int | None = None,
    size: tuple[int, int] = (480, 480),
    azimuth: float = -60.0,
    elevation: float = 15.0,
    up: str = "z",
    colors: Any = None,
    ground: bool = True,
    background: Sequence[float] | None = None,
    field_of_view: float = 24.0,
    margin: float = 0.10,
    samples: int = 3,
    font_size: int | None = None,
) -> NDArray[np.uint8]:
    """Picture of several shapes of one mesh side by side on one seamless background.

    All cells have the same camera, which frames all shapes together, the same light and the same
    ground level. So what looks larger, higher or farther left really is. The same input gives the
    same bytes.

    Parameters
    ----------
    shapes : sequence of (n, 3)
        One or more shapes, for instance rest and posed.
    faces : array_like of int, (f, 3)
        Triangles of every shape, outward.
    labels : sequence of str, optional
        A caption under each shape; an empty one leaves its place blank.
    columns : int, optional
        Shapes per row; by default all up to 4, or else rows of about equal length up to 4.
    size : (int, int)
        Width and height in pixels of one cell, without its caption.
    colors : array_like (3,) or (n, 3), or a list of them, one per shape, optional
        sRGB in 0..1. Default: clay.
    font_size : int, optional
        Height of captions in pixels; by default a 20th of the cell's height, at least 13.
    azimuth, elevation, up, ground, background, field_of_view, margin, samples
        As for `render`.

    Returns
    -------
    ndarray, (height, width, 3) uint8

    Raises
    ------
    ValueError
        As for `render`, and if there is no shape, shapes differ in their number of vertices, or
        there is another number of labels than of shapes.
    """
    width, height = checked_size(size, who="render_row")
    count = len(shapes)
    columns = _checked_layout(count, labels, columns)
    text = _checked_font_size(font_size, height)
    scene = Scene.of(shapes, faces, _color_list(colors, count), who="render_row")

    strip = round(2.2 * text) if labels is not None else 0
    rows = -(-count // columns)
    sheet = backdrop(columns * width, rows * (height + strip), background)
    exposures = list(
        scene.exposures(
            size=(width, height),
            azimuth=azimuth,
            elevation=elevation,
            up=up,
            field_of_view=field_of_view,
            margin=margin,
            ground=ground,
            samples=checked_samples(samples, who="render_row"),
        )
    )
    corners = [_corner(i, columns, count, width, height + strip) for i in range(count)]
    for corner, exposure in zip(corners, exposures, strict=True):
        _cast(sheet, corner, exposure)
    for (left, top), exposure in zip(corners, exposures, strict=True):
        cell = sheet[top : top + height, left : left + width]
        cell[:] = exposure.over(cell)
    image = to_bytes(sheet)
    if labels is not None:
        middles = [(left + width // 2, top + height) for left, top in corners]
        write_captions(image, labels, middles, size=text)
    return image


def _corner(number: int, columns: int, count: int, width: int, height: int) -> tuple[int, int]:
    """Left and top of a cell; a last row that is not full is centred."""
    row, column = divmod(number, columns)
    missing = columns - min(columns, count - row * columns)
    return column * width + missing * width // 2, row * height


def _cast(sheet: NDArray[np.float64], corner: tuple[int, int], exposure: Exposure) -> None:
    """Darken the sheet by a shadow, which may reach into neighbouring cells."""
    beside = round(SPILL[0] * exposure.camera.width)
    beyond = round(SPILL[1] * exposure.camera.height)
    shadow = exposure.shadow(around=(beside, beyond))
    fade = np.outer(_ramp(shadow.shape[0], beyond), _ramp(shadow.shape[1], beside))
    shadow = 1.0 - fade * (1.0 - shadow)

    left, top = corner[0] - beside, corner[1] - beyond
    part = sheet[max(top, 0) : top + len(shadow), max(left, 0) : left + len(shadow[0])]
    rows, columns = max(-top, 0), max(-left, 0)
    part *= shadow[rows : rows + len(part), columns : columns + part.shape[1], None]


def _ramp(length: int, border: int) -> NDArray[np.float64]:
    """(length,) smoothly from 0 at the ends to 1 where a border ends."""
    place = np.arange(length) + 0.5
    rise = np.clip(np.minimum(place, length - place) / max(border, 1), 0.0, 1.0)
    smooth: NDArray[np.float64] = rise * rise * (3.0 - 2.0 * rise)
    return smooth


def _color_list(colors: Any, count: int) -> list[Any]:
    """One entry per shape: a list of `count` arrays is split, anything else is shared."""
    if isinstance(colors, list | tuple) and len(colors) == count:
        if all(np.ndim(color) >= 1 or color is None for color in colors):
            return list(colors)
    return [colors] * count


def _checked_layout(count: int, labels: Sequence[str] | None, columns: int | None) -> int:
    if count == 0:
        raise ValueError("render_row: shapes is empty; give at least one shape, (n, 3)")
    if labels is not None and (isinstance(labels, str) or len(labels) != count):
        raise ValueError(
            f"render_row: {len(labels)} labels for {count} shapes; give a list with one for each"
        )
    if columns is None:
        rows = -(-count // 4)
        return -(-count // rows)
    if not isinstance(columns, int | np.integer) or columns < 1:
        raise ValueError(f"render_row: columns is {columns!r}; give a whole number from 1 up")
    return min(int(columns), count)


def _checked_font_size(font_size: int | None, height: int) -> int:
    if font_size is None:
        return max(13, round(height / 20))
    if not isinstance(font_size, int | np.integer) or not 4 <= font_size <= 500:
        raise ValueError(f"render_row: font_size is {font_size!r}; give whole pixels, 4 to 500")
    return int(font_size)
