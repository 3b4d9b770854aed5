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
    fans = _fans(faces)
    return fans is not None and int(fans.max()) + 1 == len(np.unique(faces))


def pinched_vertices(faces: NDArray[np.int32]) -> NDArray[np.intp]:
    """The vertices with several fans of faces, ascending; every edge must have two faces."""
    fans = _fans(faces)
    assert fans is not None
    pairs = np.unique(np.stack([faces.reshape(-1), fans], axis=1), axis=0)
    vertices, counts = np.unique(pairs[:, 0], return_counts=True)
    return np.asarray(vertices[counts > 1], np.intp)


def _fans(faces: NDArray[np.int32]) -> NDArray[np.int32] | None:
    """The fan of each corner (3 f,), from 0; None unless every edge has two consistent faces."""
    stride = np.int64(faces.max()) + 1
    start = faces.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    directed = (start * stride + end).reshape(-1)
    reverse = (end * stride + start).reshape(-1)
    order = np.argsort(directed)
    ascending = directed[order]
    if np.any(ascending[1:] == ascending[:-1]):
        return None
    position = np.minimum(np.searchsorted(ascending, reverse), len(ascending) - 1)
    if not np.array_equal(ascending[position], reverse):
        return None

    # Corner c of the faces (row-major) starts directed edge c. Around a vertex, corner c is joined
    # to the corner of the next face, which follows the reverse of edge c.
    across = order[position]
    following = across - across % 3 + (across + 1) % 3
    corners = np.arange(faces.size)
    graph = coo_array((np.ones(faces.size, np.int8), (corners, following)), shape=(faces.size,) * 2)
    _, fans = connected_components(graph, directed=False)
    return np.asarray(fans)


def euler_characteristic(faces: NDArray[np.int32]) -> int:
    """Vertices - edges + faces of a closed manifold surface: 2 - 2 genus if it is connected."""
    edges = 3 * len(faces) // 2
    return int(len(np.unique(faces)) - edges + len(faces))
