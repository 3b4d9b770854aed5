"""Shapes of a surface as base + sum_i c_i modes_i, the modes as 16-bit integers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

LARGEST = 32767


def quantised(modes: ArrayLike) -> tuple[NDArray[np.int16], NDArray[np.float32]]:
    """Modes as 16-bit integers, one scale per mode.

    Parameters
    ----------
    modes : array_like, (k, 3s)

    Returns
    -------
    integers : ndarray of int16, (k, 3s)
    scales : ndarray of float32, (k,)
        modes = scales * integers to within 1.6e-5 of the largest entry of each mode. Half floats
        take the same space, but their errors are up to 2.4e-4 of an entry, too much where modes
        are large.
    """
    rows = np.asarray(modes, np.float64)
    most = np.abs(rows).max(axis=1, initial=0.0)
    scales = (most / LARGEST).astype(np.float32)
    # a zero mode has scale zero, and any divisor will do
    integers = np.rint(rows / np.where(most > 0, most, 1.0)[:, None] * LARGEST)
    return integers.astype(np.int16), scales
