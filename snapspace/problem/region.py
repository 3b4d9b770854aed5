"""Vertices of a mesh by place: boxes and spheres."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Corner = Sequence[float | None]


def in_box(vertices: ArrayLike, lower: Corner, upper: Corner) -> NDArray[np.bool_]:
    """Mask (n,) of the vertices in an axis-aligned box, faces included.

    Parameters
    ----------
    vertices : array_like, (n, 3)
    lower, upper : three numbers; None leaves that side open

    Raises
    ------
    ValueError
        For a corner that does not have three entries, or a lower bound above the upper one.
    """
    points = np.asarray(vertices, np.float64)
    for corner in (lower, upper):
        if len(corner) != 3:
            raise ValueError(f"box: a corner needs three numbers (or null), got {list(corner)}")
    low = np.array([-np.inf if bound is None else float(bound) for bound in lower])
    high = np.array([np.inf if bound is None else float(bound) for bound in upper])
    if np.isnan(low).any() or np.isnan(high).any() or (low > high).any():
        raise ValueError(
            f"box: the lower corner {list(lower)} must be below the upper corner {list(upper)}"
        )
    inside: NDArray[np.bool_] = np.all((points >= low) & (points <= high), axis=1)
    return inside


def in_sphere(vertices: ArrayLike, center: Sequence[float], radius: float) -> NDArray[np.bool_]:
    """Mask (n,) of the vertices within `radius` > 0 of `center`; ValueError for bad values."""
    points = np.asarray(vertices, np.float64)
    if len(center) != 3 or not np.isfinite(np.asarray(center, np.float64)).all():
        raise ValueError(f"sphere: the center needs three finite numbers, got {list(center)}")
    if not (np.isfinite(radius) and radius > 0):
        raise ValueError(f"sphere: the radius is {radius}, but it must be positive")
    inside: NDArray[np.bool_] = (
        np.linalg.norm(points - np.asarray(center, np.float64), axis=1) <= radius
    )
    return inside
