"""Symmetric positive definite matrices of many shapes, and random ones."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy import sparse

from snapspace.generators import bar
from snapspace.mesh import TetMesh

from ..shapes import one_tet
from ..snapshots.creatures import creature

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]


def by_columns(A: Any) -> tuple[IndexArray, IndexArray, FloatArray]:
    A = sparse.csc_array(A)
    A.sort_indices()
    return A.indptr.astype(np.int32), A.indices.astype(np.int32), A.data.astype(np.float64)


def mesh_matrix(mesh: TetMesh) -> Any:
    """A Laplacian of the mesh's edges, made definite by a shift of every fifth vertex."""
    n = len(mesh.vertices)
    i = mesh.tets[:, [0, 0, 0, 1, 1, 2]].reshape(-1)
    j = mesh.tets[:, [1, 2, 3, 2, 3, 3]].reshape(-1)
    weights = 1 / np.linalg.norm(mesh.vertices[i] - mesh.vertices[j], axis=1)
    edges = sparse.csc_array((weights, (i, j)), shape=(n, n))
    edges = edges + edges.T
    return sparse.csc_array(sparse.diags_array(edges.sum(axis=0) + (np.arange(n) % 5 == 0)) - edges)


def star(n: int) -> Any:
    """A star: no fill-in if the centre comes last, a dense factor if it comes first."""
    A = np.diag(np.full(n, 2.0))
    A[0, :] = A[:, 0] = -1.0
    A[0, 0] = n
    return sparse.csc_array(A)


def dense(n: int) -> Any:
    factor = np.random.default_rng(0).normal(size=(n, n))
    return sparse.csc_array(factor @ factor.T + np.eye(n))


def parts() -> Any:
    """Components of several sizes, single vertices among them."""
    part = mesh_matrix(bar(5, 2, 2))
    return sparse.block_diag([[[2.0]], part, np.diag([3.0, 5.0]), 7.0 * part], format="csc")


MATRICES: dict[str, Any] = {
    "one vertex": sparse.csc_array([[4.0]]),
    "one tet": mesh_matrix(one_tet()),
    "diagonal": sparse.diags_array(np.arange(1.0, 20.0)),
    "chain": sparse.diags_array([-1.0, 2.0, -1.0], offsets=[-1, 0, 1], shape=(50, 50)),
    "star": star(40),
    "dense": dense(37),
    "bar": mesh_matrix(bar(12, 4, 4)),
    "creature": mesh_matrix(creature(5000)),
    "parts": parts(),
}


@st.composite
def random_matrices(draw: st.DrawFn) -> Any:
    """Diagonally dominant, of 1 to 40 vertices, from hardly any edges to all."""
    n = draw(st.integers(1, 40))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    upper = np.triu(rng.normal(size=(n, n)), 1)
    upper[rng.random((n, n)) > draw(st.floats(0.0, 1.0))] = 0.0
    A = upper + upper.T
    return sparse.csc_array(A + np.diag(np.abs(A).sum(axis=0) + rng.uniform(0.1, 1.0, n)))
