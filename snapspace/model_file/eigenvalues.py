"""The eigenvalues of a subspace as an array; one that is not from snapshots has none."""

from __future__ import annotations

import numpy as np

from ..subspace import AffineSubspace
from .container import Arrays

_NAME = "eigenvalues"


def eigenvalue_arrays(subspace: AffineSubspace) -> Arrays:
    """The array, if there are eigenvalues."""
    return {} if subspace.eigenvalues is None else {_NAME: subspace.eigenvalues}


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Type of the array, if there is one."""
    return {_NAME: np.float64} if _NAME in arrays else {}
