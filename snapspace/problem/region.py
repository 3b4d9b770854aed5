"""Vertices of a mesh by place: boxes and spheres."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import is_finite, is_number, shown
from ..mesh.arrays import as_points

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
        For vertices of another shape, a corner that does not have three entries, or a lower bound
        above the upper one.
    """
    points = as_points(vertices, who="box")
    for corner in (lower, upper):
        if not _is_triple(corner, open_sides=True):
            raise ValueError(f"box: a corner needs three numbers (or null), got {shown(corner)}")
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
    points = as_points(vertices, who="sphere")
    if not _is_triple(center) or not all(map(is_finite, center)):
        raise ValueError(f"sphere: the center needs three finite numbers, got {shown(center)}")
    if not (is_finite(radius) and radius > 0):
        raise ValueError(f"sphere: the radius is {shown(radius)}, but it must be positive")
    inside: NDArray[np.bool_] = (
        np.linalg.norm(points - np.asarray(center, np.float64), axis=1) <= radius
    )
    return inside


def _is_triple(values: Any, *, open_sides: bool = False) -> bool:
    """Whether the entries are three numbers, or None for open sides."""
    array = np.asarray(values, dtype=object)
    return array.shape == (3,) and all(is_number(x) or (open_sides and x is None) for x in array)
