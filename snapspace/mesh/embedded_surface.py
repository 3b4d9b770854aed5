"""EmbeddedSurface: a triangle surface that follows the tets of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array, csr_array

from ..arguments import as_numbers, require_count, require_type
from .arrays import FloatArray, IndexArray, as_indices
from .body import Body
from .check_body import check_body
from .surface import compact_surface
from .surface_file import SurfaceFile
from .validation import check_indices

# Rounding of weights that sum to one, relative to the sum of their sizes.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class EmbeddedSurface:
    """A surface whose vertices are fixed affine combinations of tet vertices.

    Parameters
    ----------
    faces : array_like of int, (f, 3)
        Triangles; the indices are those of the surface's s vertices.
    corners : array_like of int, (s, 4)
        Tet vertices that each surface vertex follows.
    weights : array_like, (s, 4)
        Their weights. Rows sum to one; a vertex outside its tet has negative weights.
    source : SurfaceFile, optional
        The user's file with these s vertices. Models store it, and shapes are written into it.

    Raises
    ------
    ValueError
        For wrong shapes or types, indices out of range, or weights that are not finite or do not
        sum to one.

    Notes
    -----
    Because the rows sum to one, an affine motion of the tets moves the surface in the same way.
    Arrays are copied and read-only. `embed_surface` and `boundary_surface` make these surfaces.
    """

    faces: IndexArray
    corners: IndexArray
    weights: FloatArray
    source: SurfaceFile | None = None

    def __repr__(self) -> str:
        return f"EmbeddedSurface({len(self.corners)} vertices, {len(self.faces)} faces)"

    def __post_init__(self) -> None:
        who = "EmbeddedSurface"
        faces = as_indices(self.faces, corners=3, who=who, what="faces")
        corners = as_indices(self.corners, corners=4, who=who, what="corners")
        weights = np.array(as_numbers(who, "weights", self.weights), order="C")
        require_type(who, "source", self.source, SurfaceFile | None, "give open_surface(path)")
        if weights.shape != corners.shape:
            raise ValueError(
                f"{who}: weights must have the shape of corners, {corners.shape}, got "
                f"{weights.shape}"
            )
        check_indices(faces, len(corners), who=who, what="face")
        if corners.size and corners.min() < 0:
            row = int(np.flatnonzero((corners < 0).any(axis=1))[0])
            raise ValueError(
                f"{who}: vertex {row} has the negative corner {corners[row].min()}; corners are "
                "0-based indices of tet vertices"
            )
        size = np.abs(weights).sum(axis=1)
        fine = np.isfinite(size) & (np.abs(weights.sum(axis=1) - 1.0) <= _ROUNDING * size)
        wrong = np.flatnonzero(~fine)
        if wrong.size:
            row = int(wrong[0])
            raise ValueError(
                f"{who}: the weights of vertex {row} sum to {weights[row].sum():.12g}, not to one; "
                f"{wrong.size} of {len(weights)} vertices affected: divide each row by its sum"
            )
        for name, array in (("faces", faces), ("corners", corners), ("weights", weights)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @cached_property
    def exact(self) -> bool:
        """Whether every surface vertex is a single tet vertex."""
        return bool(((self.weights == 1.0).sum(axis=1) == 1).all()) and (
            np.count_nonzero(self.weights) == len(self.weights)
        )

    @cached_property
    def nearest(self) -> IndexArray:
        """The tet vertex with the largest weight for each surface vertex, (s,)."""
        largest = self.weights.argmax(axis=1)
        nearest: IndexArray = self.corners[np.arange(len(largest)), largest]
        nearest.setflags(write=False)
        return nearest

    def following(self, vertices: ArrayLike) -> NDArray[np.intp]:
        """The surface vertices that follow one of these tet vertices most, ascending.

        ValueError for anything but indices, such as a mask.
        """
        wanted = as_numbers("EmbeddedSurface", "vertices", vertices)
        if wanted.size and np.asarray(vertices).dtype.kind not in "iu":
            raise ValueError(
                "EmbeddedSurface: vertices must be indices of tet vertices, but are "
                f"{np.asarray(vertices).dtype}; np.flatnonzero(mask) gives those of a mask"
            )
        return np.flatnonzero(np.isin(self.nearest, wanted))

    def is_boundary(self, mesh: Body) -> bool:
        """Whether this is `boundary_surface(mesh)`."""
        own = boundary_surface(mesh)
        return (
            self.exact
            and np.array_equal(self.nearest, own.nearest)
            and np.array_equal(self.faces, own.faces)
        )

    def vertices(self, shape: ArrayLike) -> FloatArray:
        """The surface's vertices for a deformed mesh.

        Parameters
        ----------
        shape : array_like, (n, 3) or (3n,)
            Positions of the tet vertices.

        Returns
        -------
        ndarray, (s, 3)
            A new array. Vertices with a single weight 1 are copied without rounding.

        Raises
        ------
        ValueError
            For another shape, or fewer vertices than the corners need.
        """
        x = as_numbers("EmbeddedSurface", "the shape", shape)
        if not ((x.ndim == 1 and x.size % 3 == 0) or (x.ndim == 2 and x.shape[1] == 3)):
            raise ValueError(f"EmbeddedSurface: a shape must be (n, 3) or (3n,), got {x.shape}")
        x = x.reshape(-1, 3)
        self._check_vertex_count(len(x))
        return np.asarray(self._map @ x[: self._needed])

    def matrix(self, vertex_count: int) -> csr_array:
        """The embedding as a linear map: `matrix(n) @ X` is `vertices(X)` for X (n, 3).

        Parameters
        ----------
        vertex_count : int
            Number n of tet vertices.

        Returns
        -------
        csr_array, (s, n)
            Rows sum to one; at most four entries a row, sorted, none of them zero.

        Raises
        ------
        ValueError
            If the corners need more vertices.
        """
        require_count("EmbeddedSurface", "vertex_count", vertex_count)
        self._check_vertex_count(vertex_count)
        used = self._map
        arrays = (used.data.copy(), used.indices.copy(), used.indptr.copy())
        return csr_array(arrays, shape=(len(self.corners), vertex_count))

    @cached_property
    def _map(self) -> csr_array:
        """The matrix without columns after the last corner; four times faster than gathers."""
        row, k = np.nonzero(self.weights)
        entries = (self.weights[row, k], (row, self.corners[row, k]))
        matrix = csr_array(coo_array(entries, shape=(len(self.corners), self._needed)))
        matrix.sum_duplicates()
        matrix.eliminate_zeros()
        return matrix

    @cached_property
    def _needed(self) -> int:
        return int(self.corners.max(initial=-1)) + 1

    def _check_vertex_count(self, count: int) -> None:
        if count < self._needed:
            raise ValueError(
                f"EmbeddedSurface: the shape has {count} vertices, but the surface follows tet "
                f"vertex {self._needed - 1}: it belongs to another mesh"
            )


def single_vertices(faces: IndexArray, vertices: IndexArray) -> EmbeddedSurface:
    """The exact embedding of a surface whose vertex i is tet vertex `vertices[i]`, (s,)."""
    weights = np.zeros((len(vertices), 4))
    weights[:, 0] = 1.0
    # the same corner four times: a vertex then depends on no other, even if another is nan
    return EmbeddedSurface(faces, np.repeat(vertices[:, None], 4, axis=1), weights)


def boundary_surface(mesh: Body) -> EmbeddedSurface:
    """The mesh's own surface.

    Parameters
    ----------
    mesh : TetMesh or ShellMesh

    Returns
    -------
    EmbeddedSurface
        An exact embedding. Its vertices are `mesh.vertices[mesh.surface_vertices]`, in this order,
        and its faces those of `mesh.surface`. For tets it is closed and outward; for a shell it has
        the triangles.

    Raises
    ------
    ValueError
        For something other than a mesh.
    """
    check_body(mesh, "boundary_surface")
    _, faces = compact_surface(mesh.vertices, mesh.surface)
    return single_vertices(faces, mesh.surface_vertices)
