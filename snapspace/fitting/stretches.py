"""Stretches of tets relative to the rest shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh import TetMesh

FloatArray = NDArray[np.float64]


def stretches(mesh: TetMesh, shape: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Singular values of the deformation gradient F from the rest shape, and where det F <= 0.

    Parameters
    ----------
    mesh : TetMesh
        The mesh in its rest shape.
    shape : ndarray, (n, 3)
        Vertices of the pose.

    Returns
    -------
    singular values : ndarray, (m, 3), descending in each row, not negative
    inverted : ndarray of bool, (m,)
    """
    rest_edges = _edges(mesh, mesh.vertices)
    F = _edges(mesh, shape) @ np.linalg.inv(rest_edges)
    values = np.linalg.svd(F, compute_uv=False)
    return np.asarray(values), ~(np.linalg.det(F) > 0)


def _edges(mesh: TetMesh, shape: FloatArray) -> FloatArray:
    """Columns v1 - v0, v2 - v0, v3 - v0 of each tet, (m, 3, 3)."""
    corners = shape[mesh.tets]
    return np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2)
