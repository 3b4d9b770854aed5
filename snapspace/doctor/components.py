"""Connected parts of a triangle surface, and orientations that agree within them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..mesh.arrays import IndexArray
from ..mesh.edges import Edges

Labels = NDArray[np.intp]


def face_components(faces: IndexArray, vertex_count: int) -> Labels:
    """The component of each face, (f,): faces that share a vertex are connected."""
    rows = faces[:, [0, 0]].ravel().astype(np.intp)
    columns = faces[:, 1:].ravel().astype(np.intp)
    label = connected(rows, columns, vertex_count)[faces[:, 0]]
    return np.unique(label, return_inverse=True)[1].reshape(-1)


def orientation(edges: Edges) -> tuple[NDArray[np.bool_], Labels, NDArray[np.bool_]]:
    """Which faces to flip so that neighbours agree.

    Neighbours are two faces at an edge with no other face.

    Returns
    -------
    turn : ndarray of bool, (f,)
        The faces to flip: at most half of each patch.
    patch : ndarray of int, (f,)
        The patch of each face: faces connected by such edges.
    twisted : ndarray of bool, (f,)
        Faces of patches that have no orientation, like a Moebius strip.
    """
    count = len(edges.of_face)
    flat = edges.of_face.ravel()
    order = np.argsort(flat, kind="stable")
    pairs = edges.uses[flat[order]] == 2
    slots = order[pairs].reshape(-1, 2)  # the two corners of each edge with two faces
    left, right = slots[:, 0] // 3, slots[:, 1] // 3
    along = edges.along.ravel()
    agree = along[slots[:, 0]] != along[slots[:, 1]]
    # two nodes per face, as it is and flipped; an edge connects those that agree
    rows = np.concatenate([left, left + count])
    columns = np.concatenate(
        [np.where(agree, right, right + count), np.where(agree, right + count, right)]
    )
    label = connected(rows, columns, 2 * count)
    kept, turned = label[:count], label[count:]
    patch = np.unique(np.minimum(kept, turned), return_inverse=True)[1].reshape(-1)
    # a face whose kept node has the higher label is on the other side of its patch
    other = kept > turned
    share = np.bincount(patch, other) / np.bincount(patch)
    turn = np.where(share[patch] > 0.5, ~other, other)
    return turn & (kept != turned), patch, kept == turned


def connected(rows: Labels, columns: Labels, count: int) -> Labels:
    """The component of each of `count` nodes; each pair (rows, columns) is connected."""
    graph = coo_array((np.ones(len(rows), np.int8), (rows, columns)), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], np.intp)
