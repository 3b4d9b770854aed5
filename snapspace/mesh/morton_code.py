"""Morton (Z-order) codes of points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray

_BITS = 10  # per axis


def morton_codes(points: FloatArray) -> NDArray[np.uint32]:
    """Position of each point along a Morton curve: points with similar codes are close together.

    Parameters
    ----------
    points : ndarray, (k, 3)
        k > 0.

    Returns
    -------
    ndarray of uint32, (k,)
        Interleaved bits of the three coordinates, x highest, in 1024 steps of the longest side of
        the bounding box. Points in the same cell of this grid share a code.
    """
    lower, size = points.min(axis=0), float(np.ptp(points, axis=0).max())
    scale = (2**_BITS - 1) / size if size > 0.0 else 0.0
    steps = ((points - lower) * scale).astype(np.uint32)
    x, y, z = (_spread(steps[:, axis]) for axis in range(3))
    return x << np.uint32(2) | y << np.uint32(1) | z


def _spread(value: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Move each bit i of a 10-bit number to bit 3 i."""
    for shift, mask in ((16, 0x030000FF), (8, 0x0300F00F), (4, 0x030C30C3), (2, 0x09249249)):
        value = (value | value << np.uint32(shift)) & np.uint32(mask)
    return value
