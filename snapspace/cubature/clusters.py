"""clusters: groups of neighbouring points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

#: Sizes of groups are multiples of this, so that SIMD lanes of a group are full.
MULTIPLE = 8


def clusters(points: FloatArray, size: int) -> list[IndexArray]:
    """Divides points (r, 3) into groups of at most `size`, halving along the longest extent.

    Each group has the indices of its points, ascending. Their numbers are multiples of eight,
    except the last one; so must `size` be.
    """
    return _halves(points, np.arange(len(points)), size)


def _halves(points: FloatArray, own: IndexArray, size: int) -> list[IndexArray]:
    if len(own) <= size:
        return [np.sort(own)]
    parts = -(-len(own) // size)
    first = round(len(own) * (parts // 2) / parts / MULTIPLE) * MULTIPLE
    centred = points[own] - points[own].mean(axis=0)
    axis = np.linalg.eigh(centred.T @ centred)[1][:, -1]
    place = centred @ (axis * np.sign(axis[np.abs(axis).argmax()]))
    # Rounded, so that rounding errors do not decide between points at the same place.
    place = np.round(place / max(np.abs(place).max(), np.finfo(float).tiny), 9)
    ranked = own[np.argsort(place, kind="stable")]
    return _halves(points, ranked[:first], size) + _halves(points, ranked[first:], size)
