"""Natural handles of the creature, as regions of space and as vertices of one of its meshes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from snapspace.mesh.tet_mesh import TetMesh

# In the format of problem files: a box is [[min], [max]] with None for unbounded, a sphere is
# [[x, y, z], radius]; a region is the union of its boxes and spheres. "feet" is the fixed one.
CREATURE_REGIONS: dict[str, dict[str, list[Any]]] = {
    "feet": {"boxes": [[[None, None, None], [None, None, 0.25]]]},
    "head": {"boxes": [[[0.4, None, 1.5], [None, None, None]]]},
    "tail": {"boxes": [[[None, None, 1.2], [-1.0, None, None]]]},
}


def creature_handles(mesh: TetMesh) -> dict[str, NDArray[np.int32]]:
    """Finds the vertices of `mesh` in each of `CREATURE_REGIONS`.

    Parameters
    ----------
    mesh : TetMesh
        A mesh made by `creature`, of any size, not moved.

    Returns
    -------
    dict of str to ndarray of int32
        "feet" (all four, to be fixed), "head" (with ears and horns) and "tail" (its end): sorted
        vertex indices, inside and on the surface; disjoint, none empty.

    Raises
    ------
    ValueError
        If a region has no vertices: the mesh is not the creature, or was moved.
    """
    handles = {}
    for name, region in CREATURE_REGIONS.items():
        vertices = np.flatnonzero(_in_region(mesh.vertices, region)).astype(np.int32)
        if len(vertices) == 0:
            raise ValueError(
                f"creature_handles: no vertex lies in the region {name!r};"
                " the mesh must be as made by creature(), not moved or scaled"
            )
        handles[name] = vertices
    return handles


def _in_region(points: NDArray[np.float64], region: dict[str, list[Any]]) -> NDArray[np.bool_]:
    inside = np.zeros(len(points), dtype=np.bool_)
    for lower, upper in region.get("boxes", []):
        low = [-np.inf if bound is None else bound for bound in lower]
        high = [np.inf if bound is None else bound for bound in upper]
        inside |= ((points >= low) & (points <= high)).all(axis=1)
    for centre, radius in region.get("spheres", []):
        offset = points - np.asarray(centre, dtype=np.float64)
        inside |= (offset * offset).sum(axis=1) <= radius * radius
    return inside
