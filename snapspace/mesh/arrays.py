"""The two array types of this package, and the conversion of input to them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..input_error import InputError

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]

_LARGEST_INDEX = int(np.iinfo(np.int32).max)


def as_points(values: ArrayLike, *, who: str, what: str = "vertices") -> FloatArray:
    """A new C-contiguous float64 array of n points, (n, 3); ValueError for any other input."""
    array = _as_array(values, who=who, what=what)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(who, f"{what} must have shape (n, 3), got {array.shape}")
    if array.dtype.kind not in "fiu":
        raise InputError(who, f"{what} must be real numbers, got dtype {array.dtype}")
    return np.array(array, dtype=np.float64, order="C")


def as_indices(values: ArrayLike, *, corners: int, who: str, what: str) -> IndexArray:
    """A new C-contiguous int32 array of m index rows, (m, corners); ValueError for other input.

    Floating-point indices are refused rather than truncated.
    """
    array = _as_array(values, who=who, what=what)
    if array.ndim != 2 or array.shape[1] != corners:
        raise InputError(who, f"{what} must have shape (m, {corners}), got {array.shape}")
    if array.dtype.kind not in "iu":
        raise InputError(who, f"{what} must be integers, got dtype {array.dtype}")
    if array.size and (int(array.max()) > _LARGEST_INDEX or int(array.min()) < -_LARGEST_INDEX):
        raise InputError(who, f"{what} has an index that does not fit in 32 bits")
    return np.array(array, dtype=np.int32, order="C")


def _as_array(values: ArrayLike, *, who: str, what: str) -> NDArray[np.generic]:
    try:
        return np.asarray(values)
    except (TypeError, ValueError):
        raise InputError(who, f"{what} is not a rectangular array of numbers") from None
