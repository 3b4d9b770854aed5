"""The closed surface of a mesh, for the tests of both filling methods."""

from __future__ import annotations

import numpy as np

from snapspace.mesh import TetMesh, compact_surface

Surface = tuple[np.ndarray, np.ndarray]


def surface_of(mesh: TetMesh) -> Surface:
    return compact_surface(mesh.vertices, mesh.surface)


def tube(radii: np.ndarray, heights: np.ndarray, columns: int) -> Surface:
    """A closed surface of revolution about z: a bottom point, rings of vertices, and a top point.

    radii, heights : those of the rings, from the bottom to the top, with both points as radius 0
    """
    rings, turn = len(radii) - 2, np.arange(columns)
    angles = 2 * np.pi * turn / columns
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    middle = np.concatenate(
        [
            np.column_stack([r * circle, np.full(columns, z)])
            for r, z in zip(radii[1:-1], heights[1:-1], strict=True)
        ]
    )
    vertices = np.vstack([[[0, 0, heights[0]]], middle, [[0, 0, heights[-1]]]])
    following, faces = (turn + 1) % columns, []
    for ring in range(rings - 1):
        low = 1 + ring * columns
        a, b, c, d = low + turn, low + following, low + columns + turn, low + columns + following
        faces += [np.column_stack([a, b, d]), np.column_stack([a, d, c])]
    last = 1 + (rings - 1) * columns
    faces.append(np.column_stack([np.zeros_like(turn), 1 + following, 1 + turn]))
    faces.append(
        np.column_stack([last + turn, last + following, np.full(columns, len(vertices) - 1)])
    )
    return vertices, np.vstack(faces).astype(np.int32)
