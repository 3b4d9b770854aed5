"""Lattice tets divided into eight, and tets beside them divided to fit.

Nodes are whole numbers, `node_keys`, so that the middle of an edge is the mean of its ends, and the
same node for all tets that share the edge. A tet is a row of four nodes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace.stuffing.cut_points import TET_EDGES

Keys = NDArray[np.int64]
Mask = NDArray[np.bool_]

_BITS = 20  # of a coordinate in a key
#: Coordinates of nodes are below this.
MOST_COORDINATE = 1 << _BITS
# The three edges of each face, as numbers of TET_EDGES, with its corners.
_FACES = {
    tuple(k for k, edge in enumerate(TET_EDGES) if set(edge) <= set(face)): face
    for face in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))
}


def node_keys(coordinates: Keys) -> Keys:
    """One number for each node, (k,), from whole coordinates (k, 3) of at least 0, below 2^20."""
    x, y, z = coordinates.T
    keys: Keys = (x << (2 * _BITS)) + (y << _BITS) + z
    return keys


def coordinates_of(keys: Keys) -> Keys:
    """The whole coordinates of nodes: the inverse of `node_keys`, (..., 3)."""
    low = (1 << _BITS) - 1
    return np.stack([keys >> (2 * _BITS), (keys >> _BITS) & low, keys & low], axis=-1)


def middles(tets: Keys) -> Keys:
    """The nodes in the middle of the edges, (m, 6). All coordinates must be even."""
    return np.stack([(tets[:, i] + tets[:, j]) >> 1 for i, j in TET_EDGES], axis=1)


def eighths(tets: Keys) -> Keys:
    """Lattice tets of half the size that fill lattice tets, (8 m, 4).

    A lattice tet has its long edges between nodes 0 and 1 and between 2 and 3, as the results have.
    Four of them are in its corners, and four around the line between the middles of its long edges,
    which is half as long as these (red refinement; Molino, Bridson, Fedkiw 2003).
    """
    a, b, c, d = tets.T
    ab, ac, ad, bc, bd, cd = middles(tets).T
    parts = (
        (a, ab, ac, ad),
        (ab, b, bc, bd),
        (ac, bc, c, cd),
        (ad, bd, cd, d),
        (ab, cd, ac, ad),
        (ab, cd, bc, bd),
        (ab, cd, ac, bc),
        (ab, cd, ad, bd),
    )
    return np.concatenate([np.stack(part, axis=1) for part in parts])


def divided_edges(tets: Keys, nodes: Keys) -> Mask:
    """Which edges have their middle among nodes, which ascend: (m, 6)."""
    wanted = middles(tets)
    if not len(nodes):
        return np.zeros(wanted.shape, np.bool_)
    place = np.minimum(np.searchsorted(nodes, wanted), len(nodes) - 1)
    return np.asarray(nodes[place] == wanted)


def can_fit(divided: Mask) -> Mask:
    """Whether `fitted` has a division for tets with these divided edges, (m,)."""
    count = divided.sum(axis=1)
    one_face = np.zeros(len(divided), np.bool_)
    for edges in _FACES:
        one_face |= divided[:, edges].all(axis=1)
    return np.asarray((count <= 2) | (one_face & (count == 3)))


def fitted(tets: Keys, divided: Mask) -> Keys:
    """Tets divided so that they fit neighbours with divided edges, (k, 4) (green refinement).

    The division of a face depends only on the face, so both sides agree.
    """
    numbers = divided @ (1 << np.arange(6))
    parts = [np.zeros((0, 4), np.int64)]
    for number in np.unique(numbers):
        some = tets[numbers == number]
        edges = tuple(k for k in range(6) if number >> k & 1)
        if len(edges) == 3:
            parts += _by_face(some, _FACES[edges])
        elif len(edges) == 2:
            parts += _by_two(some, *(TET_EDGES[k] for k in edges))
        else:
            parts += [half for k in edges for half in _halves(some, TET_EDGES[k])]
    return np.concatenate(parts)


def _halves(tets: Keys, edge: tuple[int, int]) -> list[Keys]:
    """The two halves of tets on both sides of the middle of an edge."""
    halves = []
    for corner in edge:
        half = tets.copy()
        half[:, corner] = tets[:, edge].sum(axis=1) >> 1
        halves.append(half)
    return halves


def _by_face(tets: Keys, face: tuple[int, ...]) -> list[Keys]:
    """Four tets above the four parts of a face, as `eighths` has them."""
    a, b, c = (tets[:, corner] for corner in face)
    (top,) = set(range(4)) - set(face)
    ab, ac, bc = (a + b) >> 1, (a + c) >> 1, (b + c) >> 1
    parts = ((a, ab, ac), (ab, b, bc), (ac, bc, c), (ab, bc, ac))
    return [np.stack([*part, tets[:, top]], axis=1) for part in parts]


def _by_two(tets: Keys, one: tuple[int, int], other: tuple[int, int]) -> list[Keys]:
    """Four tets for opposite edges; three for edges with a common corner.

    In the face of two edges with a common corner, the diagonal starts at the smaller of the nodes
    at their other ends.
    """
    common = set(one) & set(other)
    if not common:
        return [part for half in _halves(tets, one) for part in _halves(half, other)]
    (tip,) = common
    a, top = tets[:, tip], tets[:, 6 - sum(set(one) | set(other))]
    ends = np.stack([tets[:, sum(edge) - tip] for edge in (one, other)], axis=1)
    b, c = np.sort(ends, axis=1).T
    ab, ac = (a + b) >> 1, (a + c) >> 1
    parts = ((a, ab, ac), (b, ac, ab), (b, c, ac))
    return [np.stack([*part, top], axis=1) for part in parts]
