"""largest_pivots: chooses vectors that are long and differ from each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def largest_pivots(gram: FloatArray, count: int) -> list[int]:
    """Repeatedly chooses the vector with the longest part outside the span of the chosen ones.

    These are the pivots of the Cholesky factorisation with complete pivoting (Higham 2002, Accuracy
    and Stability of Numerical Algorithms, sec. 10.3), or of QR with column pivoting on the vectors.
    Among many similar vectors it chooses one.

    Parameters
    ----------
    gram : (k, k)
        Inner products of the vectors.
    count : int
        How many vectors to choose, <= k.

    Returns
    -------
    list of int
        Distinct indices in the order of choice; a longer list begins with the shorter one. Among
        equals, and when only rounding errors are left, smaller indices come first.
    """
    left = gram.copy()
    noise = len(gram) * np.finfo(float).eps * max(float(np.diag(gram).max(initial=0.0)), 0.0)
    free = np.ones(len(gram), bool)
    chosen: list[int] = []
    for _ in range(count):
        lengths = np.where(free, np.where(np.diag(left) > noise, np.diag(left), 0.0), -1.0)
        pivot = int(np.argmax(lengths))
        if lengths[pivot] > 0.0:
            left -= np.outer(left[:, pivot], left[pivot]) / left[pivot, pivot]
        free[pivot] = False
        chosen.append(pivot)
    return chosen
