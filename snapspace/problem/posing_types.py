"""check_posing_types: what a posing problem is made of."""

from __future__ import annotations

from ..arguments import wrong_type
from ..mesh import Body, ShellMesh, TetMesh
from .handle_box import HandleBox
from .handles import Handles


def check_posing_types(mesh: Body, handles: Handles, domain: HandleBox) -> None:
    """ValueError that says what to give, for arguments of other types."""
    if not isinstance(mesh, (TetMesh, ShellMesh)):
        cure = "give a TetMesh or ShellMesh, such as TetMesh(vertices, tets)"
        raise wrong_type("PosingProblem", "mesh", mesh, cure)
    if not isinstance(handles, Handles):
        cure = "give Handles([fixed, moving]) of masks or vertex indices"
        raise wrong_type("PosingProblem", "handles", handles, cure)
    if not isinstance(domain, HandleBox):
        cure = "give HandleBox(translation=..., angle=...)"
        raise wrong_type("PosingProblem", "domain", domain, cure)
