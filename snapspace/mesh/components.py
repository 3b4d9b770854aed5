"""Connected components of a tet mesh: tets that share a vertex are connected."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .arrays import IndexArray


def tet_components(tets: IndexArray, vertex_count: int) -> IndexArray:
    """Number the components of a tet mesh, largest first.

    Parameters
    ----------
    tets : ndarray of int, (m, 4)
    vertex_count : int

    Returns
    -------
    ndarray of int32, (m,)
        Component of each tet: 0 is the component with the most tets; ties keep the order of tets.
    """
    if not len(tets):
        return np.zeros(0, dtype=np.int32)
    # a star inside each tet (corner 0 to the others) connects the same vertices as all six edges
    rows, columns = np.repeat(tets[:, 0], 3), tets[:, 1:].ravel()
    graph = coo_array(
        (np.ones(rows.size, dtype=np.int8), (rows, columns)), shape=(vertex_count, vertex_count)
    )
    _, labels = connected_components(graph, directed=False)
    _, first, labels_of_tets, sizes = np.unique(
        labels[tets[:, 0]], return_index=True, return_inverse=True, return_counts=True
    )
    rank = np.empty(len(sizes), dtype=np.int32)
    rank[np.lexsort((first, -sizes))] = np.arange(len(sizes), dtype=np.int32)
    return np.asarray(rank[labels_of_tets], dtype=np.int32)
