"""TetEdges: the edges of tets, and which of them are on the surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array

Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: Corners of a tet's edges, and of its faces.
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])
FACES = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])


@dataclass(frozen=True, eq=False)
class TetEdges:
    """Edges of tets.

    ends : (e, 2), each edge once, the smaller vertex first
    of_tets : (m, 6) edges of each tet, in the order of EDGES
    on_surface : (e,)
    surface_vertices : (n,)
    """

    ends: Integers
    of_tets: Integers
    on_surface: Flags
    surface_vertices: Flags

    @classmethod
    def of_mesh(cls, tets: Integers, vertex_count: int) -> TetEdges:
        """Finds the edges of tets (m, 4)."""
        keys = np.sort(tets[:, EDGES], axis=2).reshape(-1, 2)
        flat, places = np.unique(keys[:, 0] * vertex_count + keys[:, 1], return_inverse=True)
        faces = np.sort(tets[:, FACES], axis=2).reshape(-1, 3)
        code = (faces[:, 0] * vertex_count + faces[:, 1]) * vertex_count + faces[:, 2]
        _, first, uses = np.unique(code, return_index=True, return_counts=True)
        outside = faces[first[uses == 1]]
        rims = outside[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2)
        rim_codes = np.unique(rims[:, 0] * vertex_count + rims[:, 1])
        surface = np.zeros(vertex_count, bool)
        surface[outside] = True
        ends = np.column_stack(np.divmod(flat, vertex_count))
        return cls(ends, places.reshape(-1, 6), np.isin(flat, rim_codes), surface)

    def link_sizes(self) -> Integers:
        """How many vertices are opposite to each edge in a tet, (e,), in a manifold mesh."""
        around = np.bincount(self.of_tets.ravel(), minlength=len(self.ends))
        return np.asarray(around + self.on_surface, np.int64)


def adjacency(ends: Integers, vertex_count: int) -> csr_array:
    """Symmetric pattern (n, n) of edges (e, 2)."""
    rows, columns = np.concatenate([ends, ends[:, ::-1]]).T
    ones = np.ones(len(rows))
    return csr_array(coo_array((ones, (rows, columns)), shape=(vertex_count, vertex_count)))


def tets_of_vertices(tets: Integers, vertex_count: int) -> csr_array:
    """Pattern (n, m) of the tets around each vertex."""
    columns = np.repeat(np.arange(len(tets)), 4)
    ones = np.ones(tets.size)
    shape = (vertex_count, len(tets))
    return csr_array(coo_array((ones, (tets.ravel(), columns)), shape=shape))
