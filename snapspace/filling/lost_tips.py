"""Vertices of a surface that its tets do not reach: tips, or more."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from ..mesh.edges import edges_of

#: Largest share of the vertices in all tips together.
FEW = 1e-2


def are_tips(lost: NDArray[np.intp], faces: NDArray[np.int32]) -> bool:
    """Whether lost vertices are few, and all of them at ends of the surface.

    Such an end, for example the tip of a tail or a tusk, follows the tets next to it. A lost part
    that connects others, such as a thin bridge, does not count: its patch has neighbours on both
    sides.

    Parameters
    ----------
    lost : (k,)
        Vertices that are far from the tets.
    faces : (f, 3)
        The surface, which uses all its vertices.

    Returns
    -------
    bool
        True only for at most one in a hundred of the vertices, in patches whose neighbours are
        connected among themselves.
    """
    count = int(faces.max()) + 1
    if len(lost) > FEW * count:
        return False
    edges = _edges(faces, count)
    is_lost = np.zeros(count, bool)
    is_lost[lost] = True
    patches, patch = connected_components(edges[lost][:, lost], directed=False)
    return all(_has_one_side(lost[patch == k], edges, is_lost) for k in range(patches))


def _has_one_side(patch: NDArray[np.intp], edges: csr_array, is_lost: NDArray[np.bool_]) -> bool:
    """Whether the vertices around a patch are connected with each other."""
    around = np.unique(edges[patch].indices)
    around = around[~is_lost[around]]
    sides, _ = connected_components(edges[around][:, around], directed=False)
    return int(sides) == 1


def _edges(faces: NDArray[np.int32], count: int) -> csr_array:
    """Edges as a symmetric matrix."""
    ends = edges_of(faces).ends
    one_way = coo_array((np.ones(len(ends), np.int8), ends.T), shape=(count, count))
    return csr_array(one_way + one_way.T)
