"""morton_order: orders vertices and cells so that neighbours in space are close in memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray
from .morton_code import morton_codes


def morton_order(
    vertices: FloatArray, cells: NDArray[np.int32]
) -> tuple[FloatArray, NDArray[np.int32]]:
    """Sort vertices along a Morton (Z-order) curve, and cells by their vertices.

    Loops over cells then find vertices in the cache, and consecutive cells are close together.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    cells : ndarray of int32, (m, k)
        Triangles or tets.

    Returns
    -------
    vertices, cells
        The same mesh renumbered; the order of the vertices within each cell is kept.
    """
    order = np.argsort(morton_codes(vertices), kind="stable")
    rank = np.empty(len(order), dtype=np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    renumbered = rank[cells]
    ascending = np.sort(renumbered, axis=1)
    return vertices[order], renumbered[np.lexsort(ascending.T[::-1])]
