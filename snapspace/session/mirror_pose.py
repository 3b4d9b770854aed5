"""mirror_pose: a pose with its sides swapped."""

from __future__ import annotations

from ..arguments import require_type
from ..mesh import MirrorPlane
from ..symmetry import counterparts, plane_of
from .frame_report import FrameReport
from .posing_session import PosingSession


def mirror_pose(session: PosingSession, *, plane: MirrorPlane | None = None) -> FrameReport:
    """Swaps the motions of handles left and right of the mirror plane, mirrored, and solves.

    A handle across the plane gets the mirror image of its own motion. Mirroring twice restores the
    pose.

    Parameters
    ----------
    session : PosingSession
    plane : MirrorPlane, default that of the model
        The model's plane is the entry "mirror" of its problem file. Without that entry,
        `mirror_plane` searches for it on the model's surface, which takes about a second. To mirror
        many poses, give the plane.

    Raises
    ------
    ValueError
        For another kind of session or plane, if a handle has no counterpart (`counterparts`), if
        the map of a handle is affine but not rigid, and as for `mirror_plane`. The handles stay
        where they are.

    Examples
    --------
    >>> session.move("left ear", euler=(0, 0, 0.5))
    >>> mirror_pose(session)  # the right ear turns by -0.5
    """
    cure = "give model.session() of a posing model"
    require_type("mirror_pose", "session", session, PosingSession, cure)
    problem = session.model.problem
    plane = plane_of(session.model) if plane is None else plane
    others = counterparts(problem, plane)
    names = problem.handles.names
    alone = [name for name, other in zip(names, others, strict=True) if other is None]
    if alone:
        raise ValueError(
            f"mirror_pose: '{alone[0]}' has no counterpart across the mirror plane; add it with "
            "mirror_handle, or give another plane"
        )
    return session.move_all(
        {
            names[other]: (plane.rotations(turn), plane.vectors(shift))
            for other, (turn, shift) in zip(others, session.motions.values(), strict=True)
            if other is not None
        }
    )
