"""EnclosedSolid: what a closed surface encloses, also where parts of it overlap."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..doctor.components import face_components
from ..mesh.arrays import FloatArray
from ..mesh.signed_distance import SignedDistance
from ..stopping import check_stop
from .closed_input import ClosedInput
from .outward import BESIDE
from .surface_points import surface_points

# Overlaps are looked for at points this far apart; tets cannot fill parts as thin as that.
_SPACING = 0.01
# Points on faces are moved towards the middle by this share, off the edges: there, a point beside
# one face may be on the surface.
_INTO = 1e-3


class EnclosedSolid:
    """What a closed surface encloses. Where parts of the surface overlap, it is their union.

    Parameters
    ----------
    surface : ClosedInput
        Closed and oriented outward, of diagonal one.

    Attributes
    ----------
    vertices, faces : those of the surface
    exposed : ndarray of bool, (s,)
        Whether each vertex is on the boundary of the solid, and not inside it or in a fold that is
        inside out.
    overlaps : bool
        Whether parts of the surface are not on the boundary of the solid.
    """

    def __init__(self, surface: ClosedInput) -> None:
        self.vertices, self.faces = surface.vertices, surface.faces
        self._distance = SignedDistance(surface.vertices, surface.faces)
        _, exposed = self._points(_SPACING)
        self.exposed: NDArray[np.bool_] = exposed[: len(self.vertices)]
        self.overlaps = not exposed.all()

    @cached_property
    def is_joined(self) -> bool:
        """Whether separate parts overlap: the loops of their union are not those of the surface."""
        return self.overlaps and bool(face_components(self.faces, len(self.vertices)).any())

    def distance(self, points: FloatArray) -> FloatArray:
        """Distances of points (k, 3) from the surface, as (k,), negative inside the solid.

        Those of points inside may be distances from buried parts: only their sign is certain.
        """
        check_stop()
        distances = self._distance(points)
        if not self.overlaps:
            return distances
        sign = np.where(self._distance.windings(points) > 0, -1.0, 1.0)
        signed: FloatArray = np.copysign(distances, sign)
        return signed

    def points(self, spacing: float, *, clear: float) -> FloatArray:
        """Points of the solid's boundary without large gaps between them, see `surface_points`.

        Where parts overlap, points with solid in front of them, nearer than `clear`, are left out:
        the creases along which surfaces cross become narrower than any tet.
        """
        points, exposed = self._points(spacing, clear if self.overlaps else 0.0)
        found: FloatArray = points[exposed]
        return found

    def _points(self, spacing: float, clear: float = 0.0) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Points of the surface, the vertices first, and whether there is solid on one side only.

        Then there is none in front of them at a distance of `clear`, either.
        """
        points, face = surface_points(self.vertices, self.faces, spacing)
        count, face = len(self.vertices), face[len(self.vertices) :]
        middles = self.vertices[self.faces[face]].mean(axis=1)
        inner = _INTO * middles + (1.0 - _INTO) * points[count:]
        normals = self._distance.vertex_normals, self._distance.face_normals[face]
        places, outward = np.concatenate([points[:count], inner]), np.concatenate(normals)

        def is_solid(beyond: float) -> NDArray[np.bool_]:
            return self._distance.windings(places + beyond * outward) > 0

        exposed = is_solid(BESIDE) != is_solid(-BESIDE)
        if clear:
            exposed &= ~is_solid(clear)
        return points, exposed
