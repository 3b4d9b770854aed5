"""chosen_rows: the rows that a mask or a list of numbers selects."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import wrong_type


def chosen_rows(which: ArrayLike, count: int, *, who: str) -> NDArray[np.intp]:
    """Row numbers (c,) from a mask (count,) or from row numbers, in their order.

    Raises ValueError in the name of `who` for a mask of another length, a number that is out of
    range, or anything else.
    """
    try:
        chosen = np.asarray(which)
    except ValueError:  # rows of different lengths
        cure = f"give a boolean mask ({count},) or whole numbers (c,)"
        raise wrong_type(who, "which", which, cure) from None
    if chosen.ndim == 1 and chosen.dtype == bool:
        if len(chosen) != count:
            raise ValueError(f"{who}: the mask has {len(chosen)} entries, but there are {count}")
        return np.flatnonzero(chosen)
    if chosen.shape == (0,):
        return np.empty(0, np.intp)
    if chosen.ndim != 1 or not np.issubdtype(chosen.dtype, np.integer):
        raise ValueError(
            f"{who}: needs a boolean mask ({count},) or whole numbers (c,), got {chosen.dtype} of "
            f"shape {chosen.shape}"
        )
    outside = (chosen < 0) | (chosen >= count)
    if outside.any():
        raise ValueError(f"{who}: {chosen[outside][0]} is not between 0 and {count - 1}")
    return chosen.astype(np.intp)
