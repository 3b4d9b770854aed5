"""TetMesh: a valid, immutable tetrahedral mesh."""

from __future__ import annotations

import hashlib
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, IndexArray, as_indices, as_points
from .frozen import frozen
from .quality import dihedral_angles
from .surface import boundary_faces
from .validation import check_mesh


class TetMesh:
    """One connected solid of tets with positive volumes; its arrays are read-only.

    Parameters
    ----------
    vertices : array_like, (n, 3)
        Rest positions, in the user's length unit.
    tets : array_like of int, (m, 4)
        0-based vertex indices, det(v1 - v0, v2 - v0, v3 - v0) > 0.

    Raises
    ------
    ValueError
        For wrong shapes or types, no tets, coordinates that are not finite, an index out of range,
        a tet that repeats a vertex or another tet, a tet without volume, an inverted tet, a vertex
        that belongs to no tet, or more than one component. The message names the first offender,
        the count and the cure (mostly `repair_tets`).

    Notes
    -----
    The arrays are copied, so that validated values cannot change later. Two meshes are the same
    if their fingerprints are.
    """

    def __init__(self, vertices: ArrayLike, tets: ArrayLike) -> None:
        self._vertices = as_points(vertices, who="TetMesh")
        self._tets = as_indices(tets, corners=4, who="TetMesh", what="tets")
        self._volumes = check_mesh(self._vertices, self._tets, who="TetMesh")
        for array in (self._vertices, self._tets, self._volumes):
            array.setflags(write=False)

    @property
    def vertices(self) -> FloatArray:
        """Rest positions, (n, 3) float64."""
        return self._vertices

    @property
    def tets(self) -> IndexArray:
        """Vertex indices of the tets, (m, 4) int32."""
        return self._tets

    @property
    def cells(self) -> IndexArray:
        """The tets, which have the mass."""
        return self._tets

    @property
    def elements(self) -> IndexArray:
        """The tets, over which the elastic energy is summed."""
        return self._tets

    @property
    def measures(self) -> FloatArray:
        """Volumes of the tets."""
        return self._volumes

    @property
    def volumes(self) -> FloatArray:
        """Volumes of the tets, (m,), all positive."""
        return self._volumes

    @cached_property
    def volume(self) -> float:
        """Volume of the solid."""
        return float(self._volumes.sum())

    @cached_property
    def vertex_masses(self) -> FloatArray:
        """A quarter of the volume of the tets at each vertex (density 1), (n,)."""
        quarter = np.repeat(self._volumes / 4.0, 4)
        masses = np.bincount(self._tets.ravel(), quarter, minlength=len(self._vertices))
        return frozen(np.asarray(masses, dtype=np.float64))

    @cached_property
    def surface(self) -> IndexArray:
        """Boundary faces, outward, (f, 3) int32."""
        return frozen(boundary_faces(self._tets))

    @cached_property
    def surface_vertices(self) -> IndexArray:
        """Sorted indices of the vertices on the surface, (s,) int32."""
        return frozen(np.unique(self.surface))

    @cached_property
    def diagonal(self) -> float:
        """Length of the diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self._vertices, axis=0)))

    @cached_property
    def dihedral_angles(self) -> FloatArray:
        """Dihedral angles in degrees, (m, 6), at the edges 01, 02, 03, 12, 13, 23."""
        return frozen(dihedral_angles(self._vertices, self._tets))

    @cached_property
    def components(self) -> IndexArray:
        """Component of each tet, (m,) int32: all zero, since a TetMesh is connected."""
        return frozen(np.zeros(len(self._tets), np.int32))

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of sizes and arrays (little-endian), 64 hex digits; the same on every machine."""
        digest = hashlib.sha256(b"TetMesh %d %d " % (len(self._vertices), len(self._tets)))
        digest.update(self._vertices.astype("<f8", copy=False).tobytes())
        digest.update(self._tets.astype("<i4", copy=False).tobytes())
        return digest.hexdigest()

    def __reduce__(self) -> tuple[type[TetMesh], tuple[FloatArray, IndexArray]]:
        # unpickling runs the constructor again, which validates arrays and makes them read-only
        return TetMesh, (self._vertices, self._tets)

    def __repr__(self) -> str:
        return (
            f"TetMesh({len(self._vertices)} vertices, {len(self._tets)} tets, "
            f"volume {self.volume:.6g}, diagonal {self.diagonal:.6g})"
        )
