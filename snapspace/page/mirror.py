"""How a page mirrors poses: the plane and the counterparts of the handles."""

from __future__ import annotations

from typing import Any

from ..mesh import MirrorPlane
from ..reduction import PosingModel
from ..symmetry import NotSymmetricError, counterparts, plane_of

_CURE = "Its problem file can give the plane, as “mirror”."


def mirror_about(model: PosingModel, plane: MirrorPlane | None = None) -> dict[str, Any]:
    """The data with which the page mirrors poses, or the reason why it cannot.

    Parameters
    ----------
    model : PosingModel
    plane : MirrorPlane, default that of the model

    Returns
    -------
    dict
        {"normal": [x, y, z], "counterparts": index of each handle's counterpart}; or
        {"refused": the reason, for the reader}.
    """
    try:
        plane = plane_of(model) if plane is None else plane
    except NotSymmetricError as error:
        return {"refused": _sentence(error.finding) + f" {_CURE}"}
    except ValueError as error:
        return {"refused": _sentence(str(error))}
    others = counterparts(model.problem, plane)
    alone = [
        h.name for h, other in zip(model.problem.handles, others, strict=True) if other is None
    ]
    if alone:
        which = f"“{alone[0]}” has" if len(alone) == 1 else f"“{alone[0]}” and others have"
        return {"refused": f"{which} no counterpart on the other side."}
    return {"normal": list(plane.normal), "counterparts": list(others)}


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."
