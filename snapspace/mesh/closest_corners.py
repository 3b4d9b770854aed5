"""The vertex of a surface that is closest to each point, as seen along the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from .arrays import FloatArray, IndexArray


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
    face, _, feet = core.FaceTree(vertices, faces).closest(points, np.inf)
    away = np.linalg.norm(vertices[faces[face]] - feet[:, None], axis=2)
    corners: NDArray[np.intp] = faces[face, away.argmin(axis=1)].astype(np.intp)
    return corners
