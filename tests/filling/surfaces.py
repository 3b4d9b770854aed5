"""Closed surfaces, for the tests of both filling methods."""

from __future__ import annotations

import numpy as np

from snapspace.generators import bar
from snapspace.mesh import TetMesh, compact_surface

Surface = tuple[np.ndarray, np.ndarray]


def surface_of(mesh: TetMesh) -> Surface:
    return compact_surface(mesh.vertices, mesh.surface)


def box(*low: float, size: tuple[float, float, float] = (2.0, 1.0, 1.0)) -> Surface:
    """A box with its lowest corner at `low`, and faces of a fourth in length."""
    cells = [round(4 * side) for side in size]
    mesh = bar(*cells, length=size[0], width=size[1], height=size[2])
    vertices, faces = surface_of(mesh)
    return vertices - vertices.min(axis=0) + np.array(low), faces


def beside(*surfaces: Surface) -> Surface:
    """Several surfaces as one, each with its own vertices."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in surfaces[:-1])])
    faces = [faces + start for (_, faces), start in zip(surfaces, starts, strict=True)]
    points = np.concatenate([vertices for vertices, _ in surfaces])
    return points, np.concatenate(faces).astype(np.int32)


def inside_out(surface: Surface) -> Surface:
    vertices, faces = surface
    return vertices, np.ascontiguousarray(faces[:, ::-1])
