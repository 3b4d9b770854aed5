"""Checks of input: meshes, colours and sizes are checked once, here."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .color import checked_color
from .colormap import CLAY


def checked_faces(faces: Any, vertex_count: int, *, who: str) -> NDArray[np.int32]:
    """Faces as (f, 3) int32 with all indices in range, or ValueError."""
    array = np.asarray(faces)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{who}: faces has shape {array.shape}; give triangles, (f, 3)")
    if len(array) == 0:
        raise ValueError(f"{who}: the mesh has no faces; there is nothing to draw")
    if not np.issubdtype(array.dtype, np.integer):
        raise ValueError(f"{who}: faces has type {array.dtype}; give integer vertex indices")
    wrong = np.flatnonzero(((array < 0) | (array >= vertex_count)).any(axis=1))
    if wrong.size:
        face = int(wrong[0])
        raise ValueError(
            f"{who}: face {face} is {array[face].tolist()}, but vertices has {vertex_count} rows"
        )
    return array.astype(np.int32)


def checked_vertices(vertices: Any, *, who: str) -> NDArray[np.float64]:
    """Vertices as (n, 3) float64, or ValueError; `check_finite` follows once faces are known."""
    try:
        array = np.asarray(vertices, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{who}: vertices are not numbers; give an array (n, 3)") from error
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{who}: vertices has shape {array.shape}; give positions, (n, 3)")
    return array


def check_finite(vertices: NDArray[np.float64], used: NDArray[np.intp], *, who: str) -> None:
    """ValueError if a vertex of a face is not finite; other vertices are not checked."""
    wrong = used[~np.isfinite(vertices[used]).all(axis=1)]
    if wrong.size:
        raise ValueError(
            f"{who}: vertex {wrong[0]} is {vertices[wrong[0]].tolist()}; "
            "vertices of faces must be finite"
        )


def checked_colors(colors: Any, vertex_count: int, *, who: str) -> NDArray[np.float64]:
    """Per-vertex sRGB (n, 3) from None (clay), one colour (3,) or one per vertex."""
    if colors is None:
        return np.tile(np.array(CLAY), (vertex_count, 1))
    try:
        array = np.asarray(colors, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{who}: colors are not numbers; give sRGB values in 0..1") from error
    if array.shape == (3,):
        return np.tile(checked_color(array, who=f"{who}: colors"), (vertex_count, 1))
    if array.shape != (vertex_count, 3):
        raise ValueError(
            f"{who}: colors has shape {array.shape}; "
            f"give one colour (3,) or one per vertex, ({vertex_count}, 3)"
        )
    wrong = np.flatnonzero(~((array >= 0.0) & (array <= 1.0)).all(axis=1))
    if wrong.size:
        raise ValueError(
            f"{who}: colour {wrong[0]} is {array[wrong[0]].tolist()}; "
            "give sRGB values between 0 and 1 (divide bytes by 255)"
        )
    return array


def checked_size(size: Any, *, who: str) -> tuple[int, int]:
    """(width, height) in pixels, both at least 1 and at most 16384, or ValueError."""
    try:
        width, height = (int(v) for v in size)
        whole = (width, height) == tuple(size)
    except (TypeError, ValueError, OverflowError):
        whole = False
    if not whole or not (1 <= width <= 16384 and 1 <= height <= 16384):
        raise ValueError(
            f"{who}: size is {size!r}; give (width, height) in whole pixels, 1 to 16384"
        )
    return width, height


def checked_samples(samples: Any, *, who: str) -> int:
    """Coverage samples per pixel and direction, 1 to 8, or ValueError."""
    if not isinstance(samples, int | np.integer) or not 1 <= samples <= 8:
        raise ValueError(f"{who}: samples is {samples!r}; give a whole number from 1 to 8")
    return int(samples)
