"""check_body: refuses what is no mesh of a body."""

from __future__ import annotations

from ..arguments import wrong_type
from .body import Body
from .shell_mesh import ShellMesh
from .tet_mesh import TetMesh


def check_body(mesh: Body, who: str) -> None:
    """ValueError of `who` for something else than a mesh, such as a tuple of arrays."""
    if not isinstance(mesh, (TetMesh, ShellMesh)):
        cure = "give a TetMesh or ShellMesh, such as TetMesh(vertices, tets)"
        raise wrong_type(who, "mesh", mesh, cure)
