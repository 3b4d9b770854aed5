"""morton_order: orders vertices and tets so that neighbours in space are close in memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.morton_code import morton_codes


def morton_order(
    vertices: NDArray[np.float64], tets: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Sort vertices along a Morton (Z-order) curve, and tets by their vertices.

    Then loops over tets find their vertices in the cache.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int32, (m, 4)

    Returns
    -------
    vertices, tets
        The same mesh renumbered; the order of the vertices within each tet is kept.
    """
    order = np.argsort(morton_codes(vertices), kind="stable")
    rank = np.empty(len(order), dtype=np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    renumbered = rank[tets]
    ascending = np.sort(renumbered, axis=1)
    return vertices[order], renumbered[np.lexsort(ascending.T[::-1])]
