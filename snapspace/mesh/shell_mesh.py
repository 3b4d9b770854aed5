"""ShellMesh: a thin shell, a valid and immutable triangle mesh with a thickness."""

from __future__ import annotations

import hashlib
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..input_error import InputError
from .arrays import FloatArray, IndexArray, as_indices, as_points
from .frozen import frozen
from .hinges import hinge_measures, hinge_triangles, hinges_of
from .shell_validation import check_triangles


class ShellMesh:
    """A thin shell: an open or closed triangle surface with a thickness; arrays are read-only.

    Parameters
    ----------
    vertices : array_like, (n, 3)
        Rest positions of the middle surface, in the user's length unit.
    triangles : array_like of int, (f, 3)
        0-based vertex indices. Neighbours run along their common edge in opposite directions.
    thickness : float or array_like (f,), > 0
        In the user's length unit, for all triangles or one per triangle.

    Raises
    ------
    ValueError
        For wrong shapes or types, no triangles, coordinates that are not finite, an index out of
        range, a triangle that repeats a vertex or another triangle, a triangle without area, an
        edge of more than two triangles, neighbours of contradicting orientations, a vertex that
        belongs to no triangle, or a thickness that is not positive. The message names the first
        offender, the count and the cure.

    Notes
    -----
    Several components are allowed; each must be held by handles. Triangles that share only a vertex
    are in different components, since nothing keeps them from turning about it.

    The elements of the energy are the triangles a b c, with corners a, b, c, c, followed by the
    hinges, see `hinges`.
    """

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, *, thickness: ArrayLike) -> None:
        self._vertices = as_points(vertices, who="ShellMesh")
        self._triangles = as_indices(triangles, corners=3, who="ShellMesh", what="triangles")
        self._areas = check_triangles(self._vertices, self._triangles, who="ShellMesh")
        self._thickness = _checked_thickness(thickness, len(self._triangles))
        for array in (self._vertices, self._triangles, self._areas):
            array.setflags(write=False)

    @property
    def vertices(self) -> FloatArray:
        """Rest positions, (n, 3) float64."""
        return self._vertices

    @property
    def triangles(self) -> IndexArray:
        """Vertex indices of the triangles, (f, 3) int32."""
        return self._triangles

    @property
    def cells(self) -> IndexArray:
        """The triangles, which have the mass."""
        return self._triangles

    @property
    def thickness(self) -> float | FloatArray:
        """Thickness of all triangles, or of each, (f,)."""
        return self._thickness

    @property
    def areas(self) -> FloatArray:
        """Areas of the triangles, (f,)."""
        return self._areas

    @cached_property
    def volumes(self) -> FloatArray:
        """Areas times thickness, (f,)."""
        return frozen(np.asarray(self._areas * self._thickness))

    @cached_property
    def volume(self) -> float:
        """Volume of the shell."""
        return float(self.volumes.sum())

    @cached_property
    def vertex_masses(self) -> FloatArray:
        """A third of the volume of the triangles at each vertex (density 1), (n,)."""
        third = np.repeat(self.volumes / 3.0, 3)
        masses = np.bincount(self._triangles.ravel(), third, minlength=len(self._vertices))
        return frozen(np.asarray(masses, dtype=np.float64))

    @cached_property
    def hinges(self) -> IndexArray:
        """Edges v0 v1 between triangles v0 v1 v2 and v1 v0 v3, (h, 4): rows v0, v1, v2, v3."""
        return frozen(hinges_of(self._triangles))

    @cached_property
    def hinge_triangles(self) -> IndexArray:
        """The two triangles of each hinge, (h, 2)."""
        return frozen(hinge_triangles(self._triangles, self.hinges))

    @cached_property
    def elements(self) -> IndexArray:
        """Triangles, with their last corner twice, followed by hinges, (f + h, 4) int32."""
        corners = np.concatenate([self._triangles[:, [0, 1, 2, 2]], self.hinges])
        return frozen(np.ascontiguousarray(corners))

    @cached_property
    def measures(self) -> FloatArray:
        """Areas of triangles, and those of hinges, see `hinge_measures`; (f + h,)."""
        return frozen(np.concatenate([self._areas, hinge_measures(self._vertices, self.hinges)]))

    @property
    def surface(self) -> IndexArray:
        """The triangles."""
        return self._triangles

    @cached_property
    def surface_vertices(self) -> IndexArray:
        """All vertices, (n,) int32."""
        return frozen(np.arange(len(self._vertices), dtype=np.int32))

    @cached_property
    def diagonal(self) -> float:
        """Length of the diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self._vertices, axis=0)))

    @cached_property
    def components(self) -> IndexArray:
        """Component of each triangle, (f,) int32: those that share an edge are connected."""
        count, pairs = len(self._triangles), self.hinge_triangles
        graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(count, count))
        return frozen(np.asarray(connected_components(graph, directed=False)[1], np.int32))

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of sizes and arrays (little-endian), 64 hex digits; the same on every machine."""
        sizes = len(self._vertices), len(self._triangles)
        digest = hashlib.sha256(b"ShellMesh %d %d " % sizes)
        digest.update(self._vertices.astype("<f8", copy=False).tobytes())
        digest.update(self._triangles.astype("<i4", copy=False).tobytes())
        digest.update(np.asarray(self._thickness, "<f8").tobytes())
        return digest.hexdigest()

    def __reduce__(self) -> tuple[object, ...]:
        # unpickling runs the constructor again, which validates arrays and makes them read-only
        return _restored, (self._vertices, self._triangles, self._thickness)

    def __repr__(self) -> str:
        thickness = f"{np.min(self._thickness):g}"
        if np.ndim(self._thickness):
            thickness += f" to {np.max(self._thickness):g}"
        return (
            f"ShellMesh({len(self._vertices)} vertices, {len(self._triangles)} triangles, "
            f"thickness {thickness}, diagonal {self.diagonal:.6g})"
        )


def _restored(vertices: FloatArray, triangles: IndexArray, thickness: ArrayLike) -> ShellMesh:
    return ShellMesh(vertices, triangles, thickness=thickness)


def _checked_thickness(thickness: ArrayLike, count: int) -> float | FloatArray:
    try:
        values = np.array(thickness, np.float64)
    except (TypeError, ValueError):
        raise InputError(
            "ShellMesh", f"thickness must be a number, or one per triangle, got {thickness!r}"
        ) from None
    if values.shape not in ((), (count,)):
        raise InputError(
            "ShellMesh",
            f"thickness has shape {values.shape}, but it must be a number, or one per triangle, "
            f"({count},)",
        )
    wrong = np.flatnonzero(~(np.isfinite(values) & (values > 0)))
    if wrong.size:
        where = f" of triangle {wrong[0]}" if values.ndim else ""
        raise InputError(
            "ShellMesh", f"thickness{where} is {values.flat[wrong[0]]}, but it must be positive"
        )
    return float(values) if values.ndim == 0 else frozen(values)
