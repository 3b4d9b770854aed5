"""separated: changes tets whose boundary touches itself so that it is a manifold."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace.mesh.edges import edges_of
from snapspace.mesh.quality import turned_right
from snapspace.mesh.surface import boundary_faces
from snapspace.stuffing.largest_component import largest_component
from snapspace.stuffing.manifold import pinched_vertices
from snapspace.stuffing.pinches import parted_at_pinches
from snapspace.stuffing.stuffing_stencils import staircase

FloatArray = NDArray[np.float64]
Tets = NDArray[np.int32]


def separated(vertices: FloatArray, tets: Tets) -> tuple[FloatArray, Tets]:
    """The largest component of tets, whose boundary no longer touches itself.

    Where two parts of the boundary share an edge, the edge is halved, and tets on different sides
    of its middle get their own copies of it, as at other pinches. Where two parts still share a
    vertex, tets around it lose the half next to it, which joins what is outside on both sides.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int32, (m, 4)
        Positive volumes.

    Returns
    -------
    vertices : ndarray, (k, 3)
    tets : ndarray of int32, (j, 4)
        Positive volumes. The boundary is a closed manifold, perhaps with more loops.
    """
    edges = edges_of(boundary_faces(tets))
    for edge in edges.ends[edges.uses > 2]:
        vertices, tets = _halved(vertices, tets, edge)
    vertices, tets = largest_component(*parted_at_pinches(vertices, tets))
    for vertex in pinched_vertices(boundary_faces(tets)):
        vertices, tets = _without_corner(vertices, tets, int(vertex))
    return largest_component(vertices, tets)


def touching_vertices(tets: Tets) -> NDArray[np.intp]:
    """Vertices at which the boundary of tets touches itself.

    If it does so along edges, those at the ends of these edges.
    """
    faces = boundary_faces(tets)
    edges = edges_of(faces)
    shared = edges.uses > 2
    if not shared.any():
        return pinched_vertices(faces)
    return np.unique(edges.ends[shared]).astype(np.intp)


def _halved(vertices: FloatArray, tets: Tets, edge: NDArray[np.int32]) -> tuple[FloatArray, Tets]:
    """Tets with a new vertex in the middle of an edge."""
    around = np.isin(tets, edge).sum(axis=1) == 2
    middle = np.int32(len(vertices))
    halves = [np.where(tets[around] == end, middle, tets[around]) for end in edge]
    return (
        np.concatenate([vertices, vertices[edge].mean(axis=0)[None]]),
        np.concatenate([tets[~around], *halves]),
    )


def _without_corner(vertices: FloatArray, tets: Tets, vertex: int) -> tuple[FloatArray, Tets]:
    """Tets whose edges at a vertex are cut in their middles, without the vertex."""
    around = (tets == vertex).any(axis=1)
    bases = np.sort(tets[around][tets[around] != vertex].reshape(-1, 3), axis=1)
    others, places = np.unique(bases, return_inverse=True)
    tops = (len(vertices) + places.reshape(bases.shape)).astype(np.int32)
    # a prism between each base and its top; the diagonals follow from the order of the vertices
    corners = np.concatenate([bases, tops], axis=1)
    pieces = np.array(staircase([(0, 3), (1, 4), (2, 5)]))
    vertices = np.concatenate([vertices, (vertices[others] + vertices[vertex]) / 2.0])
    rest = turned_right(vertices, corners[:, pieces].reshape(-1, 4))
    return vertices, np.concatenate([tets[~around], rest])
