"""Morton (Z-order) codes of points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray

_BITS = 10  # per axis


def morton_codes(points: FloatArray) -> NDArray[np.uint32]:
    """Place of each point along a Morton curve: points with similar codes are close together.

    Parameters
    ----------
    points : ndarray, (k, 3)
        k > 0.

    Returns
    -------
    ndarray of uint32, (k,)
        Bits of the three coordinates interleaved, x highest, in 1024 steps of the longest side of
        the bounding box. Points of the same step share a code.
    """
    lower, size = points.min(axis=0), float(np.ptp(points, axis=0).max())
    scale = (2**_BITS - 1) / size if size > 0.0 else 0.0
    steps = ((points - lower) * scale).astype(np.uint32)
    codes = np.zeros(len(points), np.uint32)
    for bit in range(_BITS):
        for axis in range(3):
            codes |= ((steps[:, axis] >> bit) & 1) << (3 * bit + 2 - axis)
    return codes
