"""solid_of: the tets of a body, for operations that shells do not have."""

from __future__ import annotations

from .body import Body
from .tet_mesh import TetMesh


def solid_of(mesh: Body, *, who: str) -> TetMesh:
    """The body if it is a solid; a ValueError of `who` for a shell, which has no tets."""
    if not isinstance(mesh, TetMesh):
        raise ValueError(f"{who}: a shell has no tets, but they are needed here")
    return mesh
