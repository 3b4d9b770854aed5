"""DrawnSurface: the points and materials of a model's surface as glTF draws it."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh import Appearance, EmbeddedSurface, MeshNotice
from ..mesh.edges import edges_of
from ..mesh.surface_file.drawn_points import DrawnPoints, drawn_points, plain_points
from ..mesh.surface_file.own_look import own_look


@dataclass(frozen=True, eq=False)
class DrawnSurface:
    """A surface as glTF draws it.

    points : each has one normal, texture coordinate and colour
    look : the user's own materials and colours; None if the file has none to show
    normal : (r,), index of each point's normal
    normal_vertex : (g,), the surface's vertex of each normal; several at sharp edges
    both_sides : whether the surface is open, so that both sides are visible
    """

    points: DrawnPoints
    look: Appearance | None
    normal: NDArray[np.intp]
    normal_vertex: NDArray[np.intp]
    both_sides: bool

    @property
    def normal_faces(self) -> NDArray[np.int32]:
        """The normals at the corners of the triangles, (f, 3)."""
        return self.normal[self.points.triangles].astype(np.int32)


def drawn_surface(surface: EmbeddedSurface) -> DrawnSurface:
    """A surface as glTF draws it; warns of materials that are damaged or missing."""
    notes: list[str] = []
    source = surface.source
    look = None
    if source is not None:
        look = own_look(source, notes, without="the .glb file is written without them")
    for note in notes:
        warnings.warn(note, MeshNotice, stacklevel=3)
    points = plain_points(len(surface.corners), surface.faces)
    if source is not None and look is not None:
        points = drawn_points(source, look, coordinates=True)
    pairs = points.vertex * (points.crease.max(initial=0) + 1) + points.crease
    _, first, normal = np.unique(pairs, return_index=True, return_inverse=True)
    shown = look if look is not None and look.shows_anything else None
    both_sides = bool((edges_of(surface.faces).uses == 1).any())
    return DrawnSurface(points, shown, normal.reshape(-1), points.vertex[first], both_sides)
