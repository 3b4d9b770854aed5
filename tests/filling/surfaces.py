"""A closed surface as the tests of both ways to fill one take it."""

from __future__ import annotations

import numpy as np

from snapspace.mesh import TetMesh, compact_surface

Surface = tuple[np.ndarray, np.ndarray]


def surface_of(mesh: TetMesh) -> Surface:
    return compact_surface(mesh.vertices, mesh.surface)
