"""vertex_normals: unit normals of a surface's vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def vertex_normals(vertices: FloatArray, faces: NDArray[np.int32]) -> FloatArray:
    """Unit normals (s, 3): sums of the faces' normals, weighted by area.

    A vertex whose sum vanishes, or that has no face, gets the normal (0, 0, 1).
    """
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros_like(vertices)
    for corner in range(3):
        for axis in range(3):
            column = np.bincount(faces[:, corner], across[:, axis], minlength=len(vertices))
            sums[:, axis] += column
    lengths = np.linalg.norm(sums, axis=1)
    flat = ~(lengths > 0.0)
    sums[flat], lengths[flat] = (0.0, 0.0, 1.0), 1.0
    return np.asarray(sums / lengths[:, None])
