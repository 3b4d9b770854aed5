"""The smallest of each group, without sorting."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray

Integers = NDArray[np.intp]


def least_of_each(group: Integers, cost: FloatArray, index: Integers) -> Integers:
    """Position of the smallest cost in each group; ties go to the smallest index.

    Parameters
    ----------
    group : ndarray of int, (k,)
        Ascending.
    cost : ndarray, (k,)
    index : ndarray of int, (k,)

    Returns
    -------
    ndarray of int
        One position per group, ascending.
    """
    starts = np.flatnonzero(np.diff(group, prepend=-1))
    if not starts.size:
        return starts
    sizes = np.diff(starts, append=len(group))
    least = np.flatnonzero(cost == np.repeat(np.fmin.reduceat(cost, starts), sizes))
    if len(least) > len(starts):
        order = np.lexsort((index[least], group[least]))
        least = least[order[np.diff(group[least[order]], prepend=-1) > 0]]
    return least
