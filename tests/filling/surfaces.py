"""The closed surface of a mesh, for the tests of both filling methods."""

from __future__ import annotations

import numpy as np

from snapspace.mesh import TetMesh, compact_surface

Surface = tuple[np.ndarray, np.ndarray]


def surface_of(mesh: TetMesh) -> Surface:
    return compact_surface(mesh.vertices, mesh.surface)
