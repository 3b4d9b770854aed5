"""The basis of a model in a file, which takes most of the bytes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]

#: Single precision if that loses nothing, as in all models of `reduce` since version 3 of the
#: files.
DTYPES = (np.float32, np.float64)


def stored_basis(subspace: AffineSubspace) -> NDArray[np.floating]:
    """The modes (d, 3n): each mode is contiguous, and the first d' modes are a prefix."""
    modes = subspace.basis.T
    short = modes.astype(np.float32)
    return short if np.array_equal(short, modes) else modes


def read_basis(modes: NDArray[np.floating]) -> FloatArray:
    """The basis (3n, d) of stored modes, in double precision."""
    return modes.astype(np.float64, copy=False).T
