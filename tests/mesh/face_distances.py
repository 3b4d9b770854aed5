"""Distances of points from triangles, one at a time, as an oracle."""

from __future__ import annotations

import igl
import numpy as np
from numpy.typing import NDArray


def distances_from_faces(
    points: NDArray[np.float64], vertices: NDArray[np.float64], faces: NDArray[np.int32]
) -> NDArray[np.float64]:
    """Distance of each point (k, 3) from each triangle (f, 3), (k, f), by libigl."""
    columns = [
        igl.point_mesh_squared_distance(points, vertices, face[None].astype(np.int64))[0]
        for face in faces
    ]
    return np.sqrt(np.stack(columns, axis=1))
