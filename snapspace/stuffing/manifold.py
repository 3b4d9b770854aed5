"""Topology of closed triangle surfaces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def is_closed_manifold(faces: NDArray[np.int32]) -> bool:
    """Whether every edge has two consistently oriented faces, and every vertex one fan of faces.

    Parameters
    ----------
    faces : ndarray of int, (f, 3)
    """
    stride = np.int64(faces.max()) + 1
    start = faces.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    directed = (start * stride + end).reshape(-1)
    reverse = (end * stride + start).reshape(-1)
    order = np.argsort(directed)
    ascending = directed[order]
    if np.any(ascending[1:] == ascending[:-1]):
        return False
    position = np.minimum(np.searchsorted(ascending, reverse), len(ascending) - 1)
    if not np.array_equal(ascending[position], reverse):
        return False

    # Corner c of the faces (row-major) starts directed edge c. Around a vertex, corner c is joined
    # to the corner of the next face, which follows the reverse of edge c.
    across = order[position]
    following = across - across % 3 + (across + 1) % 3
    corners = np.arange(faces.size)
    graph = coo_array((np.ones(faces.size, np.int8), (corners, following)), shape=(faces.size,) * 2)
    fans, _ = connected_components(graph, directed=False)
    return bool(fans == len(np.unique(faces)))


def euler_characteristic(faces: NDArray[np.int32]) -> int:
    """Vertices - edges + faces of a closed manifold surface: 2 - 2 genus if it is connected."""
    edges = 3 * len(faces) // 2
    return int(len(np.unique(faces)) - edges + len(faces))
