"""surface_points: points on a surface without large gaps between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def surface_points(
    vertices: FloatArray, faces: NDArray[np.int32], spacing: float
) -> tuple[FloatArray, NDArray[np.intp]]:
    """The vertices of a surface, and points on faces with longer edges than `spacing`.

    Every point of the surface is closer than `spacing` to one of them.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)
    spacing : float

    Returns
    -------
    points : ndarray, (k, 3), k >= n
        The vertices come first. Points on common edges of faces occur more than once.
    face : ndarray of int, (k,)
        The face of each point, and -1 for the vertices.
    """
    corners = vertices[faces]
    edges = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    parts = np.ceil(edges.max(axis=1) / spacing).astype(np.intp)
    points, face = [vertices], [np.full(len(vertices), -1)]
    for count in np.unique(parts[parts > 1]):
        first, second = np.indices((count + 1, count + 1)).reshape(2, -1)
        weights = np.stack([first, second, count - first - second], axis=1) / count
        inside = (weights >= 0.0).all(axis=1) & (weights < 1.0).all(axis=1)
        split = np.flatnonzero(parts == count)
        points.append((weights[inside] @ corners[split]).reshape(-1, 3))
        face.append(np.repeat(split, np.count_nonzero(inside)))
    return np.concatenate(points), np.concatenate(face)
