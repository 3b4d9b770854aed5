"""mirror_handle: a problem with the counterpart of a handle."""

from __future__ import annotations

import numpy as np

from ..mesh import MirrorPlane, check_plane
from ..problem import HandleBox, Handles, PosingProblem, require_posing_problem
from .plane_search import mirror_plane
from .region import mirrored_region
from .side_names import mirrored_name

#: A handle that shares more than this with its mirror image counts as its own mirror image.
MOST_COMMON = 0.5


def mirror_handle(
    problem: PosingProblem, name: str, *, plane: MirrorPlane | None = None
) -> PosingProblem:
    """The problem with the mirror image of a handle.

    Parameters
    ----------
    problem : PosingProblem
    name : str
        The handle to mirror.
    plane : MirrorPlane, default that of `mirror_plane`

    Returns
    -------
    PosingProblem
        The counterpart, named by `mirrored_name`, comes last. If there is a handle of that name
        already, its vertices and bounds are replaced. The counterpart has the vertices near the
        mirror image (`mirrored_region`), except those of the mirrored handle. Other handles lose
        these vertices. If the handle has its own bounds, these are mirrored. Common bounds stay;
        they are zero for a handle that is held at rest.

    Raises
    ------
    ValueError
        If there is no such handle, if it lies across the plane and so is its own mirror image, if
        another handle would lose all its vertices, and as for `mirror_plane`.

    Examples
    --------
    >>> problem = mirror_handle(problem, "left ear")
    >>> problem.handles.names
    ('feet', 'left ear', 'right ear')
    """
    require_posing_problem(problem, "mirror_handle")
    mesh, handles = problem.mesh, problem.handles
    region = handles[handles.index(name)].vertices
    if plane is None:
        plane = mirror_plane(mesh.vertices, mesh.surface)
    check_plane(plane, "mirror_handle")
    other = mirrored_name(name)
    image = checked_image(name, region, mirrored_region(mesh.vertices, mesh.surface, region, plane))
    rows = {handle.name: row for handle, row in zip(handles, _rows(problem.domain), strict=True)}
    is_common = (rows[name] == problem.domain.common.bounds[0]).all()
    rows[other] = rows[name] if is_common else _mirrored(rows[name], plane)

    regions = {handle.name: np.setdiff1d(handle.vertices, image) for handle in handles}
    regions[other] = image
    lost = [own for own, vertices in regions.items() if not len(vertices)]
    if lost:
        raise ValueError(
            f"mirror_handle: the mirror image of '{name}' covers '{lost[0]}'; remove that handle, "
            f"or name it '{other}', so that it is replaced"
        )
    chosen = Handles(list(regions.values()), names=list(regions))
    return problem.with_handles(chosen, domain=_box([rows[own] for own in chosen.names[1:]]))


def checked_image(name: str, region: np.ndarray, image: np.ndarray) -> np.ndarray:
    """The vertices of a mirror image that are not in the region itself.

    ValueError if the region has more than half of its image: it lies across the plane.
    """
    own = np.setdiff1d(image, region)
    if len(image) - len(own) > MOST_COMMON * len(image):
        raise ValueError(
            f"'{name}' lies across the mirror plane and is its own mirror image, so it has no "
            "counterpart; mirror a handle on one side"
        )
    return own


def _mirrored(bounds: np.ndarray, plane: MirrorPlane) -> np.ndarray:
    shift, angle = (plane.bounds(part) for part in bounds.reshape(2, 3))
    return np.concatenate([shift, np.minimum(angle, np.pi)])


def _rows(domain: HandleBox) -> np.ndarray:
    """Bounds of all handles, (h, 6), of the first one too, zeros."""
    return np.vstack([np.zeros(6), domain.bounds])


def _box(rows: list[np.ndarray]) -> HandleBox:
    """The box with these bounds, common to all handles where they are the same."""
    bounds = np.array(rows)
    same = bounds[0] if (bounds == bounds[0]).all() else bounds
    return HandleBox(translation=same[..., :3], angle=same[..., 3:], moving=len(rows))
