"""Coordinates that were solved elsewhere, at the door."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def given_coordinates(q: ArrayLike, dimension: int) -> NDArray[np.float64]:
    """The coordinates as an array.

    Parameters
    ----------
    q : array_like, (d,)
    dimension : int
        Of the model; d is at least 1, and at most that.

    Raises
    ------
    ValueError
        For another number of coordinates, or one that is not finite.
    """
    values = np.asarray(q, np.float64)
    if values.ndim != 1 or not 1 <= len(values) <= dimension:
        raise ValueError(
            f"put: q has shape {values.shape}, but the model has {dimension} coordinates, of which "
            "the leading ones may be given"
        )
    if not np.isfinite(values).all():
        bad = np.flatnonzero(~np.isfinite(values))[0]
        raise ValueError(f"put: q[{bad}] is {values[bad]}, but it must be finite")
    return values
