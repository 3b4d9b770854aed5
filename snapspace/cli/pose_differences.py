"""Whether the user's poses differ by more than rigid motions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..fitting.targets import point_areas, registered_targets

FloatArray = NDArray[np.float64]

#: Poses nearer than this share of the diagonal are equal: files may have few digits.
EQUAL = 1e-6


def check_poses_differ(farthest: float, diagonal: float) -> None:
    """ValueError if registered poses are at most this far (`farthest`) from the first one."""
    if farthest <= EQUAL * diagonal:
        raise ValueError(
            "all poses are equal up to rigid motions, so there is nothing to blend; poses must "
            "differ by more than a rigid motion"
        )


def check_surfaces_differ(shapes: FloatArray, faces: NDArray[np.int32]) -> None:
    """As `check_poses_differ`, for surfaces (k, n, 3) that are not filled yet.

    Filling may take minutes, and rounding errors of a fit look like a motion.
    """
    areas = point_areas(shapes[0], faces)
    if not areas.sum() > 0.0:
        return  # filling says what is wrong with such a surface
    near = registered_targets(shapes[1:], shapes[0], areas)
    used = np.unique(faces)
    farthest = float(np.linalg.norm((near - shapes[0])[:, used], axis=2).max())
    check_poses_differ(farthest, float(np.linalg.norm(np.ptp(shapes[0][used], axis=0))))
