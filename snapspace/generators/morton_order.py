"""Order the vertices and tets of a mesh so that neighbours in space are near in memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_BITS = 10  # per axis


def morton_order(
    vertices: NDArray[np.float64], tets: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Sort vertices along a Morton (Z-order) curve, and tets by their vertices.

    Loops over tets then find the vertices they gather in cache.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int32, (m, 4)

    Returns
    -------
    vertices, tets
        The same mesh renumbered; the order of the vertices within each tet is kept.
    """
    lower, size = vertices.min(axis=0), float(np.ptp(vertices, axis=0).max())
    scale = (2**_BITS - 1) / size if size > 0.0 else 0.0
    grid = ((vertices - lower) * scale).astype(np.uint32)
    code = _spread(grid[:, 0]) << 2 | _spread(grid[:, 1]) << 1 | _spread(grid[:, 2])
    order = np.argsort(code, kind="stable")
    rank = np.empty(len(order), dtype=np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    renumbered = rank[tets]
    ascending = np.sort(renumbered, axis=1)
    return vertices[order], renumbered[np.lexsort(ascending.T[::-1])]


def _spread(value: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Move bit i of a 10-bit number to bit 3 i."""
    for shift, mask in ((16, 0x030000FF), (8, 0x0300F00F), (4, 0x030C30C3), (2, 0x09249249)):
        value = (value | value << np.uint32(shift)) & np.uint32(mask)
    return value
