"""Where a shape stands in its cell of a picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def placed(vertices: FloatArray) -> FloatArray:
    """The vertices (n, 3) moved to the middle of the cell, the lowest one to the ground z = 0."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    middle = 0.5 * (low + high)
    return vertices - [middle[0], middle[1], low[2]]
