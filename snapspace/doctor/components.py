"""Connected parts of a triangle surface, and orientations that agree within them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..mesh.arrays import FloatArray, IndexArray
from ..mesh.box_tree import BoxTree
from ..mesh.edges import Edges

Labels = NDArray[np.intp]


def face_components(faces: IndexArray, vertex_count: int) -> Labels:
    """The component of each face, (f,): faces that share a vertex are connected."""
    rows = faces[:, [0, 0]].ravel().astype(np.intp)
    columns = faces[:, 1:].ravel().astype(np.intp)
    label = _components(rows, columns, vertex_count)[faces[:, 0]]
    return np.unique(label, return_inverse=True)[1].reshape(-1)


def parts_apart(vertices: FloatArray, faces: IndexArray) -> tuple[Labels, FloatArray]:
    """Groups components whose bounding boxes touch; different groups are certainly apart.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3), f > 0

    Returns
    -------
    group : ndarray of int, (f,)
        The group of each face, the largest first.
    share : ndarray, (g,)
        The area of each group, as a share of the whole.
    """
    component = face_components(faces, len(vertices))
    order = np.argsort(component, kind="stable")
    starts = np.flatnonzero(np.diff(component[order], prepend=-1))
    corners = vertices[faces[order]]
    low = np.minimum.reduceat(corners.min(axis=1), starts)
    high = np.maximum.reduceat(corners.max(axis=1), starts)
    pairs = [np.concatenate(found) for found in zip(*BoxTree(low, high).overlapping(), strict=True)]
    left, right = pairs or (np.empty(0, np.intp), np.empty(0, np.intp))
    group = _components(left, right, len(starts))[component]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.bincount(group[order], np.linalg.norm(sides, axis=1))
    rank = np.argsort(-area, kind="stable")
    number = np.empty(len(rank), np.intp)
    number[rank] = np.arange(len(rank))
    return number[group], area[rank] / (area.sum() or 1.0)


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
    label = _components(rows, columns, 2 * count)
    kept, turned = label[:count], label[count:]
    patch = np.unique(np.minimum(kept, turned), return_inverse=True)[1].reshape(-1)
    # a face whose kept node has the higher label is on the other side of its patch
    other = kept > turned
    share = np.bincount(patch, other) / np.bincount(patch)
    turn = np.where(share[patch] > 0.5, ~other, other)
    return turn & (kept != turned), patch, kept == turned


def _components(rows: Labels, columns: Labels, count: int) -> Labels:
    graph = coo_array((np.ones(len(rows), np.int8), (rows, columns)), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], np.intp)
