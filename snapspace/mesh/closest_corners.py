"""The vertex of a surface that is closest to each point, as seen along the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, IndexArray
from .closest_point import closest_on_triangles
from .tet_search import closest_faces


def closest_corners(
    vertices: FloatArray, faces: IndexArray, points: FloatArray
) -> NDArray[np.intp]:
    """The corner of each point's closest triangle that is nearest to the closest point on it.

    Unlike the closest vertex, this corner never belongs to another limb where triangles are large.

    Parameters
    ----------
    vertices : ndarray, (s, 3)
    faces : ndarray of int, (f, 3)
        At least one; all vertices are used.
    points : ndarray, (k, 3)

    Returns
    -------
    ndarray of int, (k,)
        Indices of vertices.
    """
    triangles = vertices[faces]
    face, _ = closest_faces(vertices, faces, points, limit=np.inf)
    feet = closest_on_triangles(points, triangles[face])
    away = np.linalg.norm(triangles[face] - feet[:, None], axis=2)
    corners: NDArray[np.intp] = faces[face, away.argmin(axis=1)].astype(np.intp)
    return corners
