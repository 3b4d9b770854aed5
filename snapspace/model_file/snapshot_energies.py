"""The snapshot energies of a subspace as an array; one that is not from snapshots has none."""

from __future__ import annotations

import numpy as np

from ..subspace import AffineSubspace
from .container import Arrays

_NAME = "eigenvalues"  # since those of a PCA in the mass are


def energy_arrays(subspace: AffineSubspace) -> Arrays:
    """The array, if there is one."""
    return {} if subspace.snapshot_energies is None else {_NAME: subspace.snapshot_energies}


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Type of the array, if there is one."""
    return {_NAME: np.float64} if _NAME in arrays else {}
