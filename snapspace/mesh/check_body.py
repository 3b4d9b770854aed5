"""check_body: refuses anything that is not a mesh of a body."""

from __future__ import annotations

from ..arguments import wrong_type
from .body import Body
from .shell_mesh import ShellMesh
from .tet_mesh import TetMesh


def check_body(mesh: Body, who: str) -> None:
    """Raises a ValueError of `who` for anything but a mesh, such as a tuple of arrays."""
    if not isinstance(mesh, (TetMesh, ShellMesh)):
        cure = "give a TetMesh or ShellMesh, such as TetMesh(vertices, tets)"
        raise wrong_type(who, "mesh", mesh, cure)
