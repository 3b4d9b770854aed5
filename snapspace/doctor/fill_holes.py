"""Closing holes with triangles between their vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.edges import edges_of
from .cleaned import repeated_faces
from .holes import Hole, holes_of, vertices_at

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]

# Holes with more edges are not closed: the work grows with the cube.
_LONGEST = 400
# Largest distance from a plane for a flat hole, as a share of its diameter, and largest diameter of
# a small hole, as a share of the surface's diagonal.
_FLAT, _SMALL = 0.15, 0.05


def closable_holes(vertices: FloatArray, faces: IndexArray) -> list[tuple[Hole, IndexArray | None]]:
    """The holes of a surface, longest first, each with the triangles that close it.

    None for a hole that is not a simple loop, or neither flat nor small, or where a triangle would
    cover an existing face: the "hole" around a single triangle, or at the corner of a sheet.
    """
    diagonal = float(np.linalg.norm(np.ptp(vertices[faces].reshape(-1, 3), axis=0)))
    holes = holes_of(vertices, edges_of(faces))
    at_hole = np.zeros(len(vertices), np.bool_)
    at_hole[vertices_at(holes)] = True
    near = faces[at_hole[faces].all(axis=1)]
    return [(hole, _closed_by(vertices, near, hole, diagonal)) for hole in holes]


def _closed_by(
    vertices: FloatArray, near: IndexArray, hole: Hole, diagonal: float
) -> IndexArray | None:
    if hole.loop is None or not _fillable(hole, diagonal):
        return None
    fill = hole_triangles(vertices, hole.loop)
    return None if repeated_faces(np.concatenate([near, fill])).any() else fill


def _fillable(hole: Hole, diagonal: float) -> bool:
    """Whether a hole is a simple loop, and flat or small."""
    if hole.loop is None or not 3 <= hole.edges <= _LONGEST:
        return False
    return hole.flatness <= _FLAT or hole.diameter <= _SMALL * diagonal


def hole_triangles(vertices: FloatArray, loop: NDArray[np.intp]) -> IndexArray:
    """The triangulation of a loop with the smallest area, oriented like the faces around it.

    Barequet and Sharir, "Filling Gaps in the Boundary of a Polyhedron", 1995: dynamic programming
    over intervals of the loop, in n^3 / 6 steps.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    loop : ndarray of int, (k,)
        Vertices in the order in which the faces around the hole run.

    Returns
    -------
    ndarray of int32, (k - 2, 3)
    """
    points = vertices[loop]
    count = len(loop)
    cost = np.zeros((count, count))
    split = np.zeros((count, count), np.intp)
    for span in range(2, count):
        first = np.arange(count - span)
        last = first + span
        middle = first[:, None] + np.arange(1, span)
        a, b, c = points[first][:, None], points[middle], points[last][:, None]
        area = np.linalg.norm(np.cross(b - a, c - a), axis=2)
        total = cost[first[:, None], middle] + cost[middle, last[:, None]] + area
        best = total.argmin(axis=1)
        cost[first, last] = total[np.arange(len(first)), best]
        split[first, last] = middle[np.arange(len(first)), best]
    triangles = []
    stack = [(0, count - 1)]
    while stack:
        low, high = stack.pop()
        if high - low < 2:
            continue
        middle_one = int(split[low, high])
        triangles.append((high, middle_one, low))  # against the loop
        stack += [(low, middle_one), (middle_one, high)]
    return np.asarray(loop[np.array(triangles, np.intp)], np.int32)
