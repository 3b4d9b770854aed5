"""Faces with the same three vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# Three indices below this fit into one 64-bit number, which is sorted three times as fast.
_MOST_IN_A_KEY = 1 << 21


def equal_faces(faces: NDArray[np.integer]) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """An order in which faces with the same vertices follow each other.

    Parameters
    ----------
    faces : ndarray of int, (f, 3)

    Returns
    -------
    order : ndarray of int, (f,)
        Equal faces are in any order.
    same : ndarray of bool, (f - 1,)
        Whether `faces[order[k + 1]]` has the vertices of `faces[order[k]]`; empty without faces.
    """
    corners = np.sort(faces, axis=1).astype(np.int64)
    stride = int(faces.max()) + 1 if faces.size else 1
    if stride < _MOST_IN_A_KEY:
        keys = (corners[:, 0] * stride + corners[:, 1]) * stride + corners[:, 2]
        order = np.argsort(keys)
        return order, np.asarray(np.diff(keys[order]) == 0)
    order = np.lexsort(corners.T)
    return order, np.asarray(~np.diff(corners[order], axis=0).any(axis=1))
