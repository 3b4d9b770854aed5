"""Sizes of the user's poses, relative to the first one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..registration import ScalePolicy, matched_scales, scale_factors
from .console import notice

FloatArray = NDArray[np.float64]

#: A pose whose edges differ from the first one's by more than this factor gets a notice.
LARGE_CHANGE = 1.05


def scaled_poses(
    shapes: FloatArray, cells: NDArray[np.int32], names: Sequence[str], *, policy: ScalePolicy
) -> FloatArray:
    """Poses (k, n, 3) of tets or triangles, scaled by the policy, with a notice for each.

    Raises ValueError for a pose without extent, and as `matched_scales`.
    """
    for name, shape in zip(names, shapes, strict=True):
        if not np.ptp(shape, axis=0).any():
            raise ValueError(
                f"{name}: all {len(shape)} vertices are at one point, so the pose has no shape; "
                "check that the file is of the object"
            )
    scaled, factors = matched_scales(shapes, cells, policy=policy)
    for name, factor in zip(names, factors, strict=True):
        if factor != 1.0:
            notice(f"notice: {name} is scaled by {factor:.6g} to the size of {names[0]}")
    return scaled


def notice_sizes(
    shapes: FloatArray, cells: NDArray[np.int32], names: Sequence[str], *, policy: ScalePolicy
) -> None:
    """With --scale auto, a notice for each pose of another size, since that is elastic strain."""
    if policy == "auto":
        for name, factor in zip(names, scale_factors(shapes, cells), strict=True):
            if abs(np.log(factor)) > np.log(LARGE_CHANGE):
                notice(
                    f"notice: the edges of {name} are {1 / factor:.3g} times as long as those of "
                    f"{names[0]}; --scale match removes that, --scale keep accepts it"
                )
