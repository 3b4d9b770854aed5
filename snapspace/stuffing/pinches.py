"""Pinches: separates tets that meet only at a point or along an edge."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from snapspace.mesh.equal_faces import equal_faces
from snapspace.mesh.surface import FACES


def parted_at_pinches(
    vertices: NDArray[np.float64], tets: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Gives tets at a vertex that are not connected by faces their own copies of it.

    No tet moves. Without such vertices the mesh is the same, up to the order of the vertices.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int, (m, 4)

    Returns
    -------
    vertices : ndarray, (k, 3), k >= n
        The vertices of all tets, and copies at the same places.
    tets : ndarray of int32, (m, 4)
        The same tets; those around a vertex are now connected by faces with this vertex.
    """
    faces = tets[:, FACES].reshape(-1, 3)
    order, shared = equal_faces(faces)
    one, other = order[:-1][shared], order[1:][shared]
    # each tet has its own copy of a corner first; shared faces join these copies
    joined = [[_corner(tets, face // 4, faces[one, k]) for k in range(3)] for face in (one, other)]
    rows, columns = (np.concatenate(side) for side in joined)
    graph = coo_array((np.ones(rows.size, np.int8), (rows, columns)), shape=(tets.size,) * 2)
    count, copies = connected_components(graph, directed=False)
    places = np.empty((count, 3))
    places[copies] = vertices[tets.reshape(-1)]
    return places, copies.reshape(tets.shape).astype(np.int32)


def _corner(
    tets: NDArray[np.int32], which: NDArray[np.intp], vertex: NDArray[np.int32]
) -> NDArray[np.intp]:
    """4 t + c for the corner c of tet t that is a vertex."""
    found: NDArray[np.intp] = 4 * which + np.argmax(tets[which] == vertex[:, None], axis=1)
    return found
