"""counterparts: the handles that are mirror images of each other."""

from __future__ import annotations

import numpy as np

from ..mesh import MirrorPlane
from ..problem import PosingProblem

#: Of the diagonal: handles of few vertices may be so far from the mirror image of the other.
_SLACK = 0.01


def counterparts(problem: PosingProblem, plane: MirrorPlane) -> tuple[int | None, ...]:
    """For each handle, the index of the handle at its mirror image; None where there is none.

    Two handles are counterparts if each has its centroid closest to the mirror image of the
    other's, and no farther than the radius of the smaller one (root mean square), plus 1 % of the
    diagonal. A handle across the plane is its own counterpart. Names do not matter.
    """
    centers, vertices = problem.centroids, problem.mesh.vertices
    radii = np.array(
        [
            np.sqrt(((vertices[handle.vertices] - center) ** 2).sum(axis=1).mean())
            for handle, center in zip(problem.handles, centers, strict=True)
        ]
    )
    away = np.linalg.norm(plane.points(centers)[:, None] - centers, axis=2)
    away = (away + away.T) / 2.0  # equal but for rounding
    reach = np.minimum(radii[:, None], radii) + _SLACK * problem.mesh.diagonal
    closest = away.argmin(axis=1)
    return tuple(
        int(other) if closest[other] == one and away[one, other] <= reach[one, other] else None
        for one, other in enumerate(closest)
    )
