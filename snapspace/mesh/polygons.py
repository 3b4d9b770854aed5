"""Polygons of surface files, triangulated."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .file_content import FileContent, Polygons


def corner_array(corners: list[int]) -> NDArray[np.int64]:
    """Vertex indices as an array, (k,); ValueError if one does not fit in 64 bits."""
    try:
        return np.array(corners, dtype=np.int64)
    except OverflowError:
        index = max(corners, key=abs)
        raise ValueError(f"a face has vertex index {str(index)[:40]}, too large a number") from None


def fan_triangles(corners: NDArray[np.int64], sizes: ArrayLike) -> NDArray[np.int64]:
    """Triangulate polygons as fans around their first corner.

    Parameters
    ----------
    corners : ndarray of int, (sum of sizes,)
        Vertex indices of the polygons, one after the other.
    sizes : array_like of int, (polygons,)
        Number of corners of each polygon, at least 3.

    Returns
    -------
    ndarray of int64, (t, 3)
        sizes - 2 triangles per polygon, in the order and orientation of the polygons.

    Raises
    ------
    ValueError
        If a polygon has fewer than three corners.
    """
    return np.asarray(corners[fan_corners(sizes)], dtype=np.int64)


def fan_corners(sizes: ArrayLike) -> NDArray[np.int64]:
    """The same fans as indices into the list of corners, (t, 3); ValueError as `fan_triangles`."""
    size = np.asarray(sizes, dtype=np.int64)
    if size.size and size.min() < 3:
        bad = int(np.argmax(size < 3))
        raise ValueError(f"face {bad} has {size[bad]} corners; at least 3 are needed")
    triangles = size - 2
    first = np.repeat(np.cumsum(size) - size, triangles)
    within = np.arange(triangles.sum()) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    fans = np.stack([first, first + within + 1, first + within + 2], axis=1)
    return np.asarray(fans, dtype=np.int64)


def surface_content(
    vertices: NDArray[np.float64],
    corners: NDArray[np.int64],
    sizes: ArrayLike,
    normals: NDArray[np.int64] | None = None,
) -> FileContent:
    """The content of a surface file, with polygons and their triangles."""
    polygons = Polygons(corners, np.asarray(sizes, dtype=np.int64), normals)
    return FileContent(vertices, {"triangle": fan_triangles(corners, sizes)}, polygons)
