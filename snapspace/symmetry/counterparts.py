"""counterparts: the handles that are mirror images of each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh import MirrorPlane, check_plane
from ..problem import PosingProblem, require_posing_problem
from .side_names import mirrored_name

#: Tolerance relative to the diagonal, for handles of few vertices.
_SLACK = 0.01


def counterparts(problem: PosingProblem, plane: MirrorPlane) -> tuple[int | None, ...]:
    """For each handle, the index of the handle at its mirror image; None where there is none.

    Handles with names of the two sides (`mirrored_name`) are counterparts if each centroid is
    closer to the mirror image of the other than to its own mirror image. Other handles are
    counterparts if the centroid of each is the closest one to the mirror image of the other, and no
    farther from it than the radius of the smaller one (root mean square) plus 1 % of the diagonal.
    A handle across the plane is its own counterpart.

    ValueError for something other than a PosingProblem and a MirrorPlane.
    """
    require_posing_problem(problem, "counterparts")
    check_plane(plane, "counterparts")
    centers = problem.centroids
    away = np.linalg.norm(plane.points(centers)[:, None] - centers, axis=2)
    away = (away + away.T) / 2.0  # equal up to rounding
    found = _named(problem.handles.names, away)
    radii = _radii(problem)
    reach = np.minimum(radii[:, None], radii) + _SLACK * problem.mesh.diagonal
    away[list(found)] = away[:, list(found)] = np.inf
    closest = away.argmin(axis=1)
    for one, other in enumerate(closest.tolist()):
        if closest[other] == one and away[one, other] <= reach[one, other]:
            found[one] = other
    return tuple(found.get(one) for one in range(len(centers)))


def _named(names: tuple[str, ...], away: NDArray[np.float64]) -> dict[int, int]:
    """The counterparts by name that are on different sides."""
    pairs = {
        one: names.index(mirrored_name(name))
        for one, name in enumerate(names)
        if mirrored_name(name) in names
    }
    return {
        one: other
        for one, other in pairs.items()
        if away[one, other] < min(away[one, one], away[other, other])
    }


def _radii(problem: PosingProblem) -> NDArray[np.float64]:
    """Root mean square distances of the handles' vertices from their centroids, (h,)."""
    vertices = problem.mesh.vertices
    return np.array(
        [
            np.sqrt(((vertices[handle.vertices] - center) ** 2).sum(axis=1).mean())
            for handle, center in zip(problem.handles, problem.centroids, strict=True)
        ]
    )
