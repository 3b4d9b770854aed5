"""The snapshot energies of a subspace as an array; only subspaces from snapshots have them."""

from __future__ import annotations

import numpy as np

from ..subspace import AffineSubspace
from .container import Arrays

_NAME = "eigenvalues"  # which they are for a PCA in the M-norm


def energy_arrays(subspace: AffineSubspace) -> Arrays:
    """The array, if there is one."""
    return {} if subspace.snapshot_energies is None else {_NAME: subspace.snapshot_energies}


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Type of the array, if there is one."""
    return {_NAME: np.float64} if _NAME in arrays else {}
