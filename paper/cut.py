"""cut: shapes for pictures, some many times as large as the body."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: How far a drawn shape may leave the box of the full solution, as a share of its diagonal.
OUTSIDE = 0.12


def cut(shape: FloatArray, reference: FloatArray) -> FloatArray:
    """The vertices (n, 3) of a shape, clamped to a box around those of the reference."""
    low, high = reference.min(axis=0), reference.max(axis=0)
    margin = OUTSIDE * float(np.linalg.norm(high - low))
    return np.clip(shape, low - margin, high + margin)
