"""The closest points of triangles."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray


def closest_on_triangles(points: FloatArray, triangles: FloatArray) -> FloatArray:
    """The point of each triangle that is closest to the point of the same row.

    Parameters
    ----------
    points : ndarray, (k, 3)
    triangles : ndarray, (k, 3, 3)
        Corners; a triangle may have no area.

    Returns
    -------
    ndarray, (k, 3)
        The foot of the perpendicular if it falls inside the triangle, else the closest point
        on the three edges.
    """
    closest = np.zeros_like(points)
    best = np.full(len(points), np.inf)
    for k in range(3):
        start, edge = triangles[:, k], triangles[:, (k + 1) % 3] - triangles[:, k]
        along = np.einsum("ij,ij->i", points - start, edge)
        length = np.einsum("ij,ij->i", edge, edge)
        share = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
        candidate = start + np.clip(share, 0.0, 1.0)[:, None] * edge
        squared = ((points - candidate) ** 2).sum(axis=1)
        closer = squared < best
        closest[closer], best[closer] = candidate[closer], squared[closer]
    inside, foot = _perpendicular(points, triangles)
    closest[inside] = foot[inside]
    return closest


def _perpendicular(points: FloatArray, triangles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Whether the perpendicular meets the triangle, (k,), and where it meets its plane, (k, 3)."""
    origin = triangles[:, 0]
    first, second = triangles[:, 1] - origin, triangles[:, 2] - origin
    normal = np.cross(first, second)
    area = np.einsum("ij,ij->i", normal, normal)
    offset = points - origin
    scale = np.divide(1.0, area, out=np.zeros_like(area), where=area > 0)
    v = np.einsum("ij,ij->i", np.cross(offset, second), normal) * scale
    w = np.einsum("ij,ij->i", np.cross(first, offset), normal) * scale
    inside = (area > 0) & (v >= 0) & (w >= 0) & (v + w <= 1)
    return inside, origin + v[:, None] * first + w[:, None] * second
