"""Distances from the planes of the surface around a vertex (Garland & Heckbert 1997)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import snapspace as ss

FloatArray = NDArray[np.float64]
Integers = NDArray[np.int64]

_TINY = np.finfo(np.float64).tiny


def surface_quadrics(mesh: ss.TetMesh) -> FloatArray:
    """Sums of areas times squared distances from the planes at each vertex, (n, 4, 4)."""
    corners = mesh.vertices[mesh.surface]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    units = normals / np.maximum(areas, _TINY)[:, None]
    planes = np.column_stack([units, -np.einsum("fi,fi->f", units, corners[:, 0])])
    forms = areas[:, None, None] * planes[:, :, None] * planes[:, None, :]
    quadrics = np.zeros((len(mesh.vertices), 4, 4))
    for corner in range(3):
        np.add.at(quadrics, mesh.surface[:, corner], forms)
    return quadrics


def squared_distances(quadrics: FloatArray, points: FloatArray) -> FloatArray:
    """Mean squared distances (k,) of points (k, 3) from the planes of quadrics (k, 4, 4)."""
    ends = np.column_stack([points, np.ones(len(points))])
    areas = np.maximum(np.trace(quadrics[:, :3, :3], axis1=1, axis2=2), _TINY)
    sums = np.maximum(np.einsum("ei,eij,ej->e", ends, quadrics, ends), 0.0)
    distances: FloatArray = sums / areas
    return distances
