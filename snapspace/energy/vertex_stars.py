"""VertexStars: the elements of an as-rigid-as-possible surface."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array

from .. import _core
from ..blas import single_threaded_blas
from .arap_triangles import KIND
from .shell_material import ShellMaterial

FloatArray = NDArray[np.float64]


class StarTriangles(NamedTuple):
    """The triangles of some stars, one after the other.

    starts : (r + 1,) int32, where those of each begin
    triangles : (t,) int32, ascending for each star
    shares : (t,), their weights in the star: shares of a third of area times modulus
    """

    starts: NDArray[np.int32]
    triangles: NDArray[np.int32]
    shares: FloatArray


class StarParts(NamedTuple):
    """Pairs of a star and a vertex whose force depends on the star's stress, vertex by vertex.

    stars : (p,) int32
    places : (p,) int32, indices of the vertices among those asked for
    vectors : (p, 3), the force is stress @ vector, for the stress of a star of modulus and area one
    """

    stars: NDArray[np.int32]
    places: NDArray[np.int32]
    vectors: FloatArray


class VertexStars:
    """The elements of an as-rigid-as-possible surface, for cubatures.

    Its energy is a quadratic form of the displacements plus the sum over stars of measure *
    density, a function of nine numbers per star; neither part is negative. The form measures how
    much the triangles of a star deviate from its best affine map. See core/energy/vertex_stars.h.

    measures : (s,), the area of each: that of its triangles, shared between stars
    material : ShellMaterial of the stars
    """

    def __init__(self, energy: _core.ElasticEnergy) -> None:
        stars = energy.stars()
        self.measures: FloatArray = stars.areas()
        self._triangles = stars.triangles()
        rows = stars.numbers()
        rows[:, 0] = stars.weights() / self.measures
        self.material = ShellMaterial(KIND, rows)
        starts, corners, gradients = stars.corners()
        neighbours, ends, couplings = stars.couplings()
        count, vertices = len(self.measures), len(neighbours) - 1
        # three rows per star, for the three columns of its gradient
        stars_of = np.repeat(np.arange(count), np.diff(starts))
        row = (3 * stars_of[:, None] + np.arange(3)).reshape(-1)
        entries = gradients.reshape(-1), (row, np.repeat(corners, 3))
        self._gradients = csr_array(entries, shape=(3 * count, vertices))
        self._weights = np.repeat(stars.weights(), 3)
        edges = csr_array((couplings, ends, neighbours), shape=(vertices, vertices))
        # a vertex is coupled to its neighbours by their edges
        self._dirichlet = csr_array(edges - diags_array(edges.sum(axis=1)))

    def __len__(self) -> int:
        return len(self.measures)

    def triangles(self, stars: NDArray[np.integer[Any]]) -> StarTriangles:
        """The triangles of some stars (r,)."""
        starts, triangles, shares = self._triangles
        rows = csr_array((shares, triangles, starts))[stars]
        return StarTriangles(rows.indptr, rows.indices, rows.data)

    def gradients(self, basis: FloatArray, stars: NDArray[np.integer[Any]]) -> FloatArray:
        """The nine numbers of displacements (3n, d) in some stars (r,), (r, 9, d).

        A basis that is C-contiguous is not copied.
        """
        rows = self._gradients[(3 * stars[:, None] + np.arange(3)).reshape(-1)]
        columns_first = self._by_vertex(rows, basis).reshape(len(stars), 3, 3, -1)
        return columns_first.swapaxes(1, 2).reshape(len(stars), 9, -1)

    def parts(self, vertices: NDArray[np.integer[Any]]) -> StarParts:
        """The stars around some vertices (v,), the same in all poses of a surface."""
        found = self._gradients.tocsc()[:, vertices].tocoo()  # the three rows of a star in turn
        vectors = self._weights[found.row] * found.data
        stars, places = found.row[::3] // 3, found.col[::3]
        return StarParts(stars.astype(np.int32), places.astype(np.int32), vectors.reshape(-1, 3))

    def dirichlet_forces(
        self, displacements: FloatArray, vertices: NDArray[np.integer[Any]]
    ) -> FloatArray:
        """The Dirichlet energy's gradient by some vertices (v,) at displacements (3n, d).

        An array (v, 3, d).
        """
        forces = 2.0 * self._by_vertex(self._dirichlet[vertices], displacements)
        return forces.reshape(len(vertices), 3, -1)

    @single_threaded_blas
    def remainder(self, basis: FloatArray) -> FloatArray:
        """The quadratic form of modes (3n, d): a matrix K (d, d) of the energy q^T K q."""
        form = basis.T @ self._forces(basis)
        return np.asarray((form + form.T) / 2.0)

    @single_threaded_blas
    def remainder_beside(self, basis: FloatArray, shape: FloatArray) -> FloatArray:
        """The form (d + 1, d + 1) of modes (3n, d) and a displacement (3n,) after them."""
        d, forces = basis.shape[1], self._forces(shape[:, None])[:, 0]
        form = np.empty((d + 1, d + 1))
        form[:d, :d] = self.remainder(basis)
        form[d, :d] = form[:d, d] = forces @ basis
        form[d, d] = forces @ shape
        return form

    def remainder_at(self, displacements: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The quadratic form at displacements (g, 3n), (g,), and its gradients (g, 3n)."""
        forces = np.stack([self._forces(u[:, None])[:, 0] for u in displacements])
        return np.einsum("gi,gi->g", displacements, forces), 2.0 * forces

    def _forces(self, displacements: FloatArray) -> FloatArray:
        """The form's matrix times displacements (3n, d)."""
        affine = self._by_vertex(self._gradients, displacements) * self._weights[:, None]
        forces = self._by_vertex(self._dirichlet, displacements) - self._gradients.T @ affine
        return np.asarray(forces).reshape(displacements.shape)

    @staticmethod
    def _by_vertex(matrix: csr_array, displacements: FloatArray) -> FloatArray:
        """A matrix (r, n) times displacements (3n, d), those of a vertex in a row: (r, 3 d)."""
        rows = np.ascontiguousarray(displacements).reshape(matrix.shape[1], -1)
        return np.asarray(matrix @ rows, np.float64)
