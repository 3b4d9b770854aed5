"""with_points: points of a surface that a page keeps, as further handles of a problem."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..mesh import Body, EmbeddedSurface
from ..problem import HandleBox, Handles, PosingProblem
from ..problem.surface_handles import FEWEST
from .message_parts import KeptPoint

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: Radius of the handle around a point, as a share of the diagonal: about an edge of quick tets.
RADIUS = 0.03


def with_points(
    problem: PosingProblem, surface: EmbeddedSurface, points: Sequence[KeptPoint]
) -> PosingProblem:
    """The problem with a handle around each point.

    A handle has the tet vertices within `RADIUS` that are connected to the point and belong to no
    other handle; if these are fewer than 3, it has those of the tets around them. Its motions have
    the common bounds of the problem's handles, or larger ones if the point was pulled farther.

    Parameters
    ----------
    problem : PosingProblem
    surface : EmbeddedSurface
        The surface that the page shows.
    points : sequence of KeptPoint

    Raises
    ------
    ValueError
        For no points, a vertex index out of range, shares that do not sum to one, a name that is
        taken, or a point with fewer than 3 free tet vertices around it; the message names the
        point.
    """
    if not points:
        raise ValueError("no points were kept, so there is nothing to improve the model for")
    handles = problem.handles
    for point in points:
        _check(point, handles, len(surface.corners))
        around = _vertices_around(point, problem.mesh, surface, handles)
        handles = handles.adding(point.name, around)
    common = problem.domain.common.bounds[0]
    reached = np.array([[*np.abs(point.reach), 0.0, 0.0, 0.0] for point in points])
    bounds = np.vstack([problem.domain.bounds, np.maximum(common, reached)])
    domain = HandleBox(translation=bounds[:, :3], angle=bounds[:, 3:], moving=len(bounds))
    same = (bounds == common).all()
    return problem.with_handles(handles, domain=problem.domain.common if same else domain)


def _check(point: KeptPoint, handles: Handles, count: int) -> None:
    if point.name in handles.names:
        raise ValueError(f"there is already a handle named '{point.name}'; rename the point")
    wrong = [corner for corner in point.corners if not 0 <= corner < count]
    if wrong or len(point.corners) != 3:
        raise ValueError(
            f"'{point.name}' has the corners {point.corners}, but it needs three vertices of the "
            f"surface, which has {count}"
        )
    if abs(sum(point.shares) - 1.0) > 1e-6:
        raise ValueError(
            f"'{point.name}' has the shares {point.shares}, but those of its corners sum to one"
        )


def _vertices_around(
    point: KeptPoint, mesh: Body, surface: EmbeddedSurface, handles: Handles
) -> NDArray[np.intp]:
    """The tet vertices of the handle around a point."""
    corners = list(point.corners)
    place = np.asarray(point.shares) @ surface.vertices(mesh.vertices)[corners]
    free = np.ones(len(mesh.vertices), np.bool_)
    for handle in handles:
        free[handle.vertices] = False
    followed = np.unique(surface.corners[corners][surface.weights[corners] > 0])
    near: Mask = np.linalg.norm(mesh.vertices - place, axis=1) <= RADIUS * mesh.diagonal
    near[followed] = True
    near &= free
    around = np.flatnonzero(near & _connected(near, followed, mesh))
    if len(around) < FEWEST:  # the tets are large: use those at the point
        beside = np.unique(mesh.cells[np.isin(mesh.cells, around).any(axis=1)])
        around = beside[free[beside]].astype(np.intp)
    if len(around) < FEWEST:
        raise ValueError(
            f"'{point.name}' has {len(around)} free vertices of the tets around it, but at least "
            f"{FEWEST} are needed: pull a point farther from other handles, or use smaller tets"
        )
    return around


def _connected(chosen: Mask, seeds: NDArray[np.int32], mesh: Body) -> Mask:
    """Which of the chosen vertices are connected to the seeds by edges between chosen ones."""
    tets = mesh.cells[chosen[mesh.cells].any(axis=1)]
    corners = range(tets.shape[1])
    pairs = np.concatenate([tets[:, [a, b]] for a in corners for b in range(a)])
    ends = pairs[chosen[pairs].all(axis=1)].T
    count = len(chosen)
    graph = coo_array((np.ones(ends.shape[1]), (ends[0], ends[1])), shape=(count, count))
    parts = connected_components(graph, directed=False)[1]
    connected: Mask = np.isin(parts, parts[seeds[chosen[seeds]]])
    return connected
