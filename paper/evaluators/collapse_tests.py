"""Which edges may be collapsed: topology, and the shapes of tets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from snapspace.mesh import tet_volumes

from .tet_edges import EDGES, adjacency

FloatArray = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: Smallest volume over the cube of the root mean square edge; 0.118 for a regular tet.
FLATTEST = 0.015


def common_neighbours(ends: Integers, pairs: Integers, vertex_count: int) -> Integers:
    """How many vertices are joined to both of each pair (k, 2) by edges (e, 2)."""
    pattern = adjacency(ends, vertex_count)
    both = pattern[pairs[:, 0]].multiply(pattern[pairs[:, 1]])
    return np.asarray(both.sum(axis=1)).astype(np.int64)


def fits(vertices: FloatArray, tets: Integers, incident: csr_array, pairs: Integers) -> Flags:
    """Whether the tets around pairs[:, 0] keep a good shape if it moves to pairs[:, 1], (k,)."""
    removed, kept = pairs.T
    counts = np.diff(incident.indptr)[removed]
    which = np.repeat(np.arange(len(pairs)), counts)
    starts = np.repeat(incident.indptr[removed] - np.cumsum(counts) + counts, counts)
    around = tets[incident.indices[starts + np.arange(len(which))]]
    stays = (around != kept[which, None]).all(axis=1)
    which, around = which[stays], around[stays]
    before = shapes(vertices, around)
    after = shapes(vertices, np.where(around == removed[which, None], kept[which, None], around))
    least_before = np.full(len(pairs), np.inf)
    least_after = np.full(len(pairs), np.inf)
    np.minimum.at(least_before, which, before)
    np.minimum.at(least_after, which, after)
    good: Flags = (least_after > 0.0) & (least_after >= np.minimum(FLATTEST, least_before))
    good &= np.isfinite(least_after)  # some tets remain
    return good


def shapes(vertices: FloatArray, tets: Integers) -> FloatArray:
    """Volume over the cube of the root mean square edge, (m,)."""
    corners = vertices[tets]
    edges = corners[:, EDGES[:, 0]] - corners[:, EDGES[:, 1]]
    lengths = np.sqrt((edges**2).sum(axis=2).mean(axis=1))
    quality: FloatArray = tet_volumes(vertices, tets.astype(np.int32)) / lengths**3
    return quality
