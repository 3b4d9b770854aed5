"""ClosedInput: a closed surface, checked and scaled for the fillers."""

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
    """A checked surface, centred at the origin with diagonal one, oriented outward.

    vertices : ndarray, (s, 3)
    faces : ndarray of int32, (f, 3)
    center : ndarray, (3,)
        Centre of the given surface's bounding box.
    diagonal : float
        Diagonal of the given surface's bounding box.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]
    center: NDArray[np.float64]
    diagonal: float


def closed_input(vertices: ArrayLike, faces: ArrayLike, *, who: str) -> ClosedInput:
    """Checks and scales a surface to diagonal one; ValueError unless it encloses a solid."""
    points = as_points(vertices, who=who)
    triangles = as_indices(faces, corners=3, who=who, what="faces")
    check_points(points, who=who)
    check_indices(triangles, len(points), who=who, what="face")
    check_closed(triangles, who=who)
    points, triangles = compact_surface(points, triangles)
    center = (points.min(axis=0) + points.max(axis=0)) / 2.0
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    # fillers have absolute thresholds, so all surfaces are scaled to the same size
    scaled = (points - center) / (diagonal or 1.0)
    volume = enclosed_volume(scaled, triangles)
    if abs(volume) < np.finfo(np.float64).eps:
        raise ValueError(
            f"{who}: the surface encloses no volume ({len(triangles)} faces), but a solid "
            "is needed; check that the surface is neither flat nor doubly covered"
        )
    outward = triangles if volume > 0 else np.ascontiguousarray(triangles[:, ::-1])
    return ClosedInput(vertices=scaled, faces=outward, center=center, diagonal=diagonal)


def check_share(value: float, name: str, *, largest: float, who: str) -> None:
    """Raises ValueError unless a share of the diagonal is positive and not too large."""
    if not 0 < value <= largest:
        raise ValueError(
            f"{who}: {name} is {value}, but must be positive and at most {largest:g}; it is "
            "a share of the diagonal"
        )
