"""Selection: the handles that a page has chosen, in the form of a problem."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..material import Material
from ..mesh import Body
from ..problem import HandleBox, Handles, PosingProblem
from .messages import Choose, HandleChoice, Vector

#: Initial bounds of a page, similar to those of problems made by hand, whose handles are about a
#: tenth of the body.
TRANSLATION_SHARE, ANGLE = 0.1, float(np.deg2rad(45))


@dataclass(frozen=True)
class Selection:
    """Handles, the fixed ones first, and the bounds of the moving handles' motions."""

    handles: Handles
    box: HandleBox

    def problem(
        self, mesh: Body, *, material: Material, stiffness: float, known: PosingProblem | None
    ) -> PosingProblem:
        """The problem of these handles.

        Parameters
        ----------
        mesh : TetMesh or ShellMesh
        material : Material
        stiffness : float
        known : PosingProblem or None
            A problem on the same mesh. It is returned if it is the same problem. If it has the same
            material and stiffness, the new problem shares its data.

        Raises
        ------
        ValueError
            As for `PosingProblem`.
        """
        if known is None or (known.material, known.stiffness) != (material, stiffness):
            return PosingProblem(
                mesh, self.handles, domain=self.box, material=material, stiffness=stiffness
            )
        problem = known.with_handles(self.handles, domain=self.box)
        return known if known.fingerprint == problem.fingerprint else problem


def selection_of(choice: Choose) -> Selection:
    """The handles and bounds of a message.

    Raises
    ------
    ValueError
        Unless at least one handle is fixed and one moves, and as for `Handles` and `HandleBox`.
    """
    ordered = sorted(choice.handles, key=lambda handle: handle.moving)  # stable
    if not ordered:
        raise ValueError("no handles are chosen; choose at least two, one of them fixed")
    if ordered[0].moving:
        raise ValueError("no handle is fixed, so the shape could float away; mark one as fixed")
    if not ordered[-1].moving:
        raise ValueError("no handle moves, so there is nothing to sample; mark one as moving")
    handles = Handles([h.vertices for h in ordered], names=[h.name for h in ordered])
    box = HandleBox(
        translation=np.array([_bounds(h, h.translation, choice.translation) for h in ordered[1:]]),
        angle=np.array([_bounds(h, h.angle, choice.angle) for h in ordered[1:]]),
        moving=len(ordered) - 1,
    )
    for handle, bounds in zip(ordered[1:], box.bounds, strict=True):
        if handle.moving and not bounds.any():
            raise ValueError(
                f"handle '{handle.name}' moves, but its ranges are all zero; widen them, or mark "
                "it as fixed"
            )
    common = box.common
    return Selection(handles, common if (common.bounds == box.bounds).all() else box)


def choices_of(problem: PosingProblem) -> tuple[HandleChoice, ...]:
    """The handles of a problem, in the form of the page."""
    common = problem.domain.common.bounds[0]
    first, *others = (
        HandleChoice(name=handle.name, vertices=tuple(handle.vertices.tolist()), moving=False)
        for handle in problem.handles
    )
    rest = [
        replace(
            choice,
            moving=True,
            translation=_unless_common(bounds[:3], common[:3]),
            angle=_unless_common(bounds[3:], common[3:]),
        )
        if bounds.any()
        else choice
        for choice, bounds in zip(others, problem.domain.bounds, strict=True)
    ]
    return (first, *rest)


def as_vector(values: np.ndarray) -> Vector:
    """The three numbers of an array."""
    x, y, z = values.tolist()
    return x, y, z


def _bounds(handle: HandleChoice, own: Vector | None, common: Vector) -> Vector:
    if not handle.moving:
        return (0.0, 0.0, 0.0)
    return common if own is None else own


def _unless_common(bounds: np.ndarray, common: np.ndarray) -> Vector | None:
    return as_vector(bounds) if (bounds != common).any() else None
