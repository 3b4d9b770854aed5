"""Validation of coordinates that were solved elsewhere."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers


def given_coordinates(q: ArrayLike, dimension: int) -> NDArray[np.float64]:
    """The coordinates as an array.

    Parameters
    ----------
    q : array_like, (d,)
    dimension : int
        The model's dimension: 1 <= d <= dimension.

    Raises
    ------
    ValueError
        For a wrong number of coordinates, or one that is not finite.
    """
    values = as_numbers("put", "q", q)
    if values.ndim != 1 or not 1 <= len(values) <= dimension:
        raise ValueError(
            f"put: q has shape {values.shape}, but the model has {dimension} coordinates; give all "
            "of them or the leading ones"
        )
    if not np.isfinite(values).all():
        bad = np.flatnonzero(~np.isfinite(values))[0]
        raise ValueError(f"put: q[{bad}] is {values[bad]}, but it must be finite")
    return values
