"""Handles on surfaces around a bar, finer and coarser than its tets."""

from __future__ import annotations

import numpy as np

from snapspace.mesh import EmbeddedSurface, embed_surface
from snapspace.problem import Handles

from .shapes import bar_problem, surface_around

PROBLEM = bar_problem()
MESH = PROBLEM.mesh
FINE = surface_around(MESH)
LENGTH = np.ptp(MESH.vertices[:, 0])


def box() -> EmbeddedSurface:
    """A surface of eight vertices, with far more tet vertices between them."""
    low, high = MESH.vertices.min(axis=0), MESH.vertices.max(axis=0)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]
    return embed_surface(low + (high - low) * corners, faces, MESH, farthest=0.1)


def along(surface: EmbeddedSurface) -> np.ndarray:
    """Positions of surface vertices between the ends, from 0 to 1."""
    x = surface.vertices(MESH.vertices)[:, 0]
    share: np.ndarray = (x - MESH.vertices[:, 0].min()) / LENGTH
    return share


def ends(surface: EmbeddedSurface, width: float = 0.2) -> Handles:
    share = along(surface)
    return Handles([share < width, share > 1 - width], names=["foot", "head"])
