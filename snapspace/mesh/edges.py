"""The edges of a triangle surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import IndexArray


@dataclass(frozen=True, eq=False)
class Edges:
    """Undirected edges (e, 2), and those of the faces.

    uses : (e,), number of faces at each edge
    balance : (e,), number of faces that run along the edge minus those that run against it
    of_face : (f, 3), edge from corner k to corner k + 1
    along : (f, 3), whether the face runs along the edge, from its lower to its higher vertex
    """

    ends: IndexArray
    uses: NDArray[np.intp]
    balance: NDArray[np.intp]
    of_face: NDArray[np.intp]
    along: NDArray[np.bool_]


def edges_of(faces: IndexArray) -> Edges:
    """The edges of faces (f, 3), f > 0, without a repeated vertex in a face."""
    first = faces.astype(np.int64)
    second = np.roll(first, -1, axis=1)
    low, high = np.minimum(first, second), np.maximum(first, second)
    keys, edge = np.unique(low << 32 | high, return_inverse=True)
    edge = edge.reshape(-1)
    along = first < second
    ends = np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=1).astype(np.int32)
    uses = np.bincount(edge, minlength=len(keys))
    forward = np.bincount(edge, along.ravel(), minlength=len(keys)).astype(np.intp)
    return Edges(ends, uses, 2 * forward - uses, edge.reshape(faces.shape), along)
