"""MirrorPlane: a plane, and the mirror images of positions, vectors, rotations and bounds."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import as_arrays, require_finite, require_type, shown
from .arrays import FloatArray

Vector = tuple[float, float, float]

_ROUNDING = 4.0 * np.finfo(float).eps


@dataclass(frozen=True)
class MirrorPlane:
    """The plane through a point with a normal.

    Parameters
    ----------
    normal : three numbers
        Of any nonzero length; stored as a unit vector.
    point : three lengths, default the origin
        Any point of the plane, in the mesh's length unit.
    deviation : float, optional
        How far a surface is from its mirror image: the root mean square distance, relative to the
        surface's diagonal. `mirror_plane` measures it.

    Raises
    ------
    ValueError
        For a normal or a point that is not three finite numbers, a normal of length zero, or a
        deviation that is not finite. Its methods raise it for arrays of another shape.

    Examples
    --------
    >>> MirrorPlane((1, 0, 0)).points([[1.0, 2.0, 3.0]])
    array([[-1.,  2.,  3.]])
    """

    normal: Vector
    point: Vector = (0.0, 0.0, 0.0)
    deviation: float | None = None

    def __post_init__(self) -> None:
        normal, point = _three(self.normal, "normal"), _three(self.point, "point")
        largest = np.abs(normal).max()
        if largest == 0:
            raise ValueError("MirrorPlane: the normal is zero; give the direction across the plane")
        # unit normals stay unchanged, so that reading a file gives the same plane
        if abs(np.linalg.norm(normal) - 1.0) > _ROUNDING:
            normal = normal / largest
            normal = normal / np.linalg.norm(normal)
        if self.deviation is not None:
            require_finite("MirrorPlane", "deviation", self.deviation)
        object.__setattr__(self, "normal", tuple(normal.tolist()))
        object.__setattr__(self, "point", tuple(point.tolist()))

    @property
    def content(self) -> dict[str, Any]:
        """The plane as an entry of a problem file, {"normal", "point"}."""
        return {"normal": list(self.normal), "point": list(self.point)}

    @cached_property
    def matrix(self) -> FloatArray:
        """H = I - 2 n n^T, (3, 3), which mirrors vectors; H H = I."""
        normal = np.array(self.normal)
        return np.eye(3) - 2.0 * np.outer(normal, normal)

    def points(self, points: ArrayLike) -> FloatArray:
        """Mirror images of positions, (..., 3)."""
        given, normal = as_arrays("MirrorPlane", "points", points, 3), np.array(self.normal)
        along = (given - np.array(self.point)) @ normal
        return np.asarray(given - 2.0 * along[..., None] * normal)

    def vectors(self, vectors: ArrayLike) -> FloatArray:
        """Mirror images of translations, (..., 3)."""
        return np.asarray(as_arrays("MirrorPlane", "vectors", vectors, 3) @ self.matrix)

    def rotations(self, rotations: ArrayLike) -> FloatArray:
        """Mirror images H R H of rotations, (..., 3, 3).

        Their axes are axial vectors: a rotation about the normal stays, one about an axis in the
        plane is reversed.
        """
        given = as_arrays("MirrorPlane", "rotations", rotations, 3, 3)
        return np.asarray(self.matrix @ given @ self.matrix)

    def bounds(self, bounds: ArrayLike) -> FloatArray:
        """Half widths, (..., 3), of the smallest box with the mirror image of a centred box.

        Exact for translations up to `bounds`, and to first order for angles. Across a coordinate
        plane nothing changes; across an oblique plane the box grows.
        """
        return np.asarray(as_arrays("MirrorPlane", "bounds", bounds, 3) @ np.abs(self.matrix))


def check_plane(plane: object, who: str) -> None:
    """Raises a ValueError of `who` for anything but a mirror plane, such as a normal."""
    require_type(who, "plane", plane, MirrorPlane, "give MirrorPlane(normal, point)")


def _three(values: ArrayLike, what: str) -> FloatArray:
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise ValueError(
            f"MirrorPlane: the {what} must be three finite numbers, got {shown(values)}"
        )
    return array
