"""Normals and tangents that follow when the points of a surface move."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from .layout import Directions

# Directions that turn by less than this stay as they are in the file.
_STILL = 1e-9
# Area over the square of the longest of two sides, below which a triangle is a line.
_LINE = 1e-9


def carried(
    directions: Directions,
    values: FloatArray,
    old: FloatArray,
    new: FloatArray,
    triangles: NDArray[np.int64],
    triangle_corners: NDArray[np.int64],
) -> tuple[NDArray[np.intp], FloatArray]:
    """Directions after a deformation.

    Each triangle maps the direction by its own affine deformation, which stretches the normal by
    the triangle's mean stretch. A direction that several corners share becomes the mean of their
    results, weighted by area at rest. So smooth and sharp edges stay as their author made them.

    Parameters
    ----------
    directions : Directions
    values : ndarray, (j, 3)
        The directions in the file.
    old, new : ndarray, (k, 3)
        Points before and after.
    triangles : ndarray of int, (t, 3)
        Points of the triangles.
    triangle_corners : ndarray of int, (t, 3)
        Corners of the triangles, as indices into `directions.of_corner`.

    Returns
    -------
    rows : ndarray of int, (r,)
        Indices of the directions that turned.
    turned : ndarray, (r, 3)
        Their new values, as long as the old ones. A direction at triangles without area stays.
    """
    used = directions.of_corner[triangle_corners]  # (t, 3)
    frame, area = _frames(old, triangles)
    moved, moved_area = _frames(new, triangles)
    # a frame of a triangle that is almost a line has no inverse
    fine = (area > _LINE * _longest(frame)) & (moved_area > _LINE * _longest(moved))
    sums = np.zeros_like(values)
    for corner in range(3):
        chosen = np.flatnonzero(fine & (used[:, corner] >= 0))
        index = used[chosen, corner]
        before, after = frame[chosen], moved[chosen]  # rows: two edges and a normal
        vectors = values[index][:, :, None]
        if directions.kind == "normal":  # products with the edges and the normal do not change
            mapped = np.linalg.solve(after, before @ vectors)
        else:  # coordinates by the edges and the normal do not change
            mapped = after.swapaxes(1, 2) @ np.linalg.solve(before.swapaxes(1, 2), vectors)
        weighted = mapped[:, :, 0] * area[chosen, None]
        for axis in range(3):
            sums[:, axis] += np.bincount(index, weighted[:, axis], minlength=len(values))
    length = np.linalg.norm(sums, axis=1)
    target = np.linalg.norm(values, axis=1)
    known = length > 0
    result = values.copy()
    result[known] = sums[known] * (target[known] / length[known])[:, None]
    turned = np.linalg.norm(result - values, axis=1) > _STILL * target
    rows = np.flatnonzero(turned)
    return rows, result[rows]


def _longest(frames: FloatArray) -> FloatArray:
    """Squares of the longer of the two edges of frames, (t,)."""
    return np.asarray((frames[:, :2] ** 2).sum(axis=2).max(axis=1))


def _frames(points: FloatArray, triangles: NDArray[np.int64]) -> tuple[FloatArray, FloatArray]:
    """Two edges and a normal of each triangle, as rows (t, 3, 3), and areas (t,).

    The normal has the length of the side of a square with twice the area, so that frames of similar
    triangles are similar.
    """
    a, b, c = points[triangles[:, 0]], points[triangles[:, 1]], points[triangles[:, 2]]
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    root = np.sqrt(length)[:, None]
    scaled = np.divide(normal, root, out=np.zeros_like(normal), where=root > 0)
    return np.stack([b - a, c - a, scaled], axis=1), length / 2.0
