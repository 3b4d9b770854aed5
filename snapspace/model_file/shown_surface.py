"""The surface of a model as arrays: its faces, and the tet vertices that its vertices follow."""

from __future__ import annotations

import numpy as np

from ..mesh import EmbeddedSurface, TetMesh, boundary_surface
from .container import Arrays, check_shapes

DTYPES: dict[str, type] = {
    "surface_faces": np.int32,
    "surface_corners": np.int32,
    "surface_weights": np.float64,
}


def surface_arrays(surface: EmbeddedSurface) -> Arrays:
    """The arrays of a surface; the names are those of DTYPES."""
    return {
        "surface_faces": surface.faces,
        "surface_corners": surface.corners,
        "surface_weights": surface.weights,
    }


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of the arrays that a file must have: all of a surface's if it has any of them."""
    return DTYPES if any(name in arrays for name in DTYPES) else {}


def surface(arrays: Arrays, mesh: TetMesh) -> EmbeddedSurface:
    """The surface in a file's arrays, or the boundary of its tets; ValueError for bad arrays."""
    if not dtypes(arrays):
        return boundary_surface(mesh)
    s = len(arrays["surface_corners"])
    check_shapes(arrays, {"surface_corners": (s, 4), "surface_weights": (s, 4)})
    for name, count in (("surface_faces", s), ("surface_corners", len(mesh.vertices))):
        indices = arrays[name]
        if indices.size and (indices.min() < 0 or indices.max() >= count):
            raise ValueError(f"'{name}' has an index that is not between 0 and {count - 1}")
    return EmbeddedSurface(
        arrays["surface_faces"], arrays["surface_corners"], arrays["surface_weights"]
    )
