"""DrawnPoints: a surface as graphics programs draw it, with one normal and colour per point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import IndexArray
from ..polygons import fan_corners
from .appearance import Appearance, Colors, Coordinates
from .layout import IntArray
from .surface_file import SurfaceFile


@dataclass(frozen=True, eq=False)
class DrawnPoints:
    """Points, each a vertex of a surface with one normal, texture coordinate and colour.

    Points are in the order of the vertices; at seams and sharp edges a vertex has several.

    vertex : (r,), the vertex of each point
    crease : (r,), points of a vertex with the same number share a normal
    triangles : (f, 3), points; sorted by material
    counts : number of triangles of each material
    coordinates : (r, 2), or None without any
    colors : (r, 3), sRGB, or None without any
    """

    vertex: IntArray
    crease: IntArray
    triangles: IntArray
    counts: tuple[int, ...]
    coordinates: Coordinates | None = None
    colors: Colors | None = None


def plain_points(vertices: int, faces: IndexArray) -> DrawnPoints:
    """One point for each vertex of a surface, and one material."""
    own = np.arange(vertices, dtype=np.int64)
    return DrawnPoints(own, np.zeros_like(own), faces.astype(np.int64), (len(faces),))


def drawn_points(source: SurfaceFile, look: Appearance, *, coordinates: bool) -> DrawnPoints:
    """The points of a file with a look; `coordinates`: whether texture coordinates matter."""
    sizes = np.diff(source.starts)
    corners = fan_corners(sizes)
    of_triangle = np.repeat(look.material_of_polygon, sizes - 2)
    order = np.argsort(of_triangle, kind="stable")
    vertices = source.corners.astype(np.int64)
    creases = _creases(vertices, look.normals)
    places = look.texture_coordinates if coordinates else None
    columns = [vertices, creases]
    if places is not None:
        columns += [*places.view(np.int32).T]
    if look.colors is not None:
        columns.append(look.colors @ np.array([1 << 16, 1 << 8, 1]))
    first, point = _distinct(columns)
    return DrawnPoints(
        vertex=vertices[first],
        crease=creases[first],
        triangles=point[corners[order]],
        counts=tuple(np.bincount(of_triangle, minlength=len(look.materials)).tolist()),
        coordinates=None if places is None else places[first],
        colors=None if look.colors is None else look.colors[first],
    )


def _creases(vertices: IntArray, normals: IntArray | None) -> IntArray:
    """For each corner, the index of its normal among those of its vertex, (c,)."""
    if normals is None:
        return np.zeros(len(vertices), np.int64)
    pairs, number = np.unique(np.stack([vertices, normals], 1), axis=0, return_inverse=True)
    _, starts, counts = np.unique(pairs[:, 0], return_index=True, return_counts=True)
    within = np.arange(len(pairs)) - np.repeat(starts, counts)
    return np.asarray(within[number.reshape(-1)])


def _distinct(columns: list[IntArray]) -> tuple[IntArray, IntArray]:
    """One row of each distinct row of columns, in ascending order, and each row's index among them.

    Column by column: sorting whole rows takes ten times as long.
    """
    number = np.zeros(len(columns[0]), np.int64)
    for column in columns:
        low = int(column.min(initial=0))
        span = int(column.max(initial=0)) - low + 1
        _, number = np.unique(number * span + (column.astype(np.int64) - low), return_inverse=True)
    _, first, number = np.unique(number, return_index=True, return_inverse=True)
    return first, number.reshape(-1)
