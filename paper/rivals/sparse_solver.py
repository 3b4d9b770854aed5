"""SparseSolver: a direct solver of symmetric positive definite systems on a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array
from scipy.sparse.linalg import splu

from snapspace import _core as core

FloatArray = NDArray[np.float64]


class SparseSolver:
    """Factors a symmetric positive definite matrix once and solves with it.

    SciPy's SuperLU without pivoting. Its own orderings cause several times as much fill-in on tet
    meshes as nested dissection of the vertices.

    Parameters
    ----------
    matrix : (k n, k n) sparse
        Unknowns of a vertex are neighbours: x0 y0 z0 x1 ... for k = 3.
    per_vertex : k
    """

    def __init__(self, matrix: csr_array, *, per_vertex: int) -> None:
        coarse = csc_array(matrix[::per_vertex, ::per_vertex])
        coarse.sort_indices()
        starts, rows = (a.astype(np.int32) for a in (coarse.indptr, coarse.indices))
        vertices = np.asarray(core.nested_dissection(starts, rows))
        self._order = (per_vertex * vertices[:, None] + np.arange(per_vertex)).ravel()
        ordered = csc_array(matrix[self._order][:, self._order])
        self._factor = splu(
            ordered,
            permc_spec="NATURAL",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )

    def solve(self, right: FloatArray) -> FloatArray:
        """Solutions (k n,) or (k n, j)."""
        result = np.empty_like(right)
        result[self._order] = self._factor.solve(np.ascontiguousarray(right[self._order]))
        return result
