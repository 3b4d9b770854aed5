"""Points spread evenly over a surface, and directions over half of the sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

# Steps of R2: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
_STEPS = 0.7548776662466927, 0.5698402909980532


def even_points(vertices: FloatArray, faces: NDArray[np.int32], count: int) -> FloatArray:
    """Points (count, 3) with the same number per area, in the order of the faces.

    The same points for the same input. The surface must have an area.
    """
    corners = vertices[faces]
    edges = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.cumsum(np.linalg.norm(np.cross(*edges), axis=1))
    k = np.arange(count)
    face = np.searchsorted(areas, (k + 0.5) / count * areas[-1])
    u, v = ((0.5 + step * k) % 1.0 for step in _STEPS)
    side = np.sqrt(u)
    weights = np.stack([1.0 - side, side * (1.0 - v), side * v], axis=1)
    return np.asarray(np.einsum("ij,ijk->ik", weights, corners[face]))


def even_directions(count: int) -> FloatArray:
    """Unit vectors over half of the sphere, (count, 3), on a spiral of golden steps."""
    k = np.arange(count) + 0.5
    height, turn = k / count, np.pi * (1.0 + np.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), height], axis=1)
