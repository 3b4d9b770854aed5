"""check_posing_types: the types of a posing problem's arguments."""

from __future__ import annotations

from ..arguments import wrong_type
from ..mesh import Body, check_body
from .handle_box import HandleBox
from .handles import Handles


def check_posing_types(mesh: Body, handles: Handles, domain: HandleBox) -> None:
    """ValueError, which says what to give, for arguments of other types."""
    check_body(mesh, "PosingProblem")
    if not isinstance(handles, Handles):
        cure = "give Handles([fixed, moving]) of masks or vertex indices"
        raise wrong_type("PosingProblem", "handles", handles, cure)
    if not isinstance(domain, HandleBox):
        cure = "give HandleBox(translation=..., angle=...)"
        raise wrong_type("PosingProblem", "domain", domain, cure)
