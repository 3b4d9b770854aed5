"""A closed surface as the fillers take it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh import compact_surface
from ..mesh.arrays import as_indices, as_points
from ..mesh.closed_surface import check_closed, enclosed_volume
from ..mesh.validation import check_indices, check_points


@dataclass(frozen=True, kw_only=True)
class ClosedInput:
    """A checked surface of diagonal one about the origin, oriented outward.

    vertices : ndarray, (s, 3)
    faces : ndarray of int32, (f, 3)
    center : ndarray, (3,)
        Of the given surface.
    diagonal : float
        Of the given surface's bounding box.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]
    center: NDArray[np.float64]
    diagonal: float


def closed_input(vertices: ArrayLike, faces: ArrayLike, *, who: str) -> ClosedInput:
    """Check a surface and bring it to diagonal one; ValueError unless it encloses a solid."""
    points = as_points(vertices, who=who)
    triangles = as_indices(faces, corners=3, who=who, what="faces")
    check_points(points, who=who)
    check_indices(triangles, len(points), who=who, what="face")
    check_closed(triangles, who=who)
    points, triangles = compact_surface(points, triangles)
    center = (points.min(axis=0) + points.max(axis=0)) / 2.0
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    # fillers have absolute thresholds: in this unit of length all surfaces have the same size
    scaled = (points - center) / (diagonal or 1.0)
    volume = enclosed_volume(scaled, triangles)
    if abs(volume) < np.finfo(np.float64).eps:
        raise ValueError(
            f"{who}: the surface encloses no volume ({len(triangles)} faces): a solid is "
            "needed; check that the surface is neither flat nor doubly covered"
        )
    outward = triangles if volume > 0 else np.ascontiguousarray(triangles[:, ::-1])
    return ClosedInput(vertices=scaled, faces=outward, center=center, diagonal=diagonal)


def check_share(value: float, name: str, *, largest: float, who: str) -> None:
    """ValueError unless a length in diagonals is positive and not too large."""
    if not 0 < value <= largest:
        raise ValueError(
            f"{who}: {name} is {value}, but must be positive and at most {largest:g}: it is "
            "a share of the diagonal"
        )
