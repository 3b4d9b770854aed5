"""The local coordinates of a cubature as arrays; only large cubatures have them."""

from __future__ import annotations

import numpy as np

from ..reduction import BlendedStars, BlendedSum, Cubature, LocalRows
from .container import Arrays, check_shapes

SIZES, ROWS, MODES = "cubature_clusters", "cubature_local_rows", "cubature_local_modes"


def local_arrays(energy: Cubature | BlendedSum) -> Arrays:
    """The arrays of a cubature with local coordinates; none for others."""
    if isinstance(energy, BlendedStars) or not isinstance(energy.stored_rows, LocalRows):
        return {}
    local = energy.stored_rows
    return {SIZES: local.sizes, ROWS: local.rows, MODES: local.modes}


def local_rows(arrays: Arrays, tets: int, dimension: int) -> LocalRows | None:
    """The rows of a file's cubature; None if it has no local coordinates.

    Raises ValueError if sizes do not match.
    """
    if SIZES not in arrays:
        return None
    sizes = arrays[SIZES]
    check_shapes(arrays, {SIZES: (len(sizes), 2), MODES: (len(arrays[MODES]), dimension)})
    if sizes.min(initial=1) < 1 or sizes[:, 0].sum(dtype=np.int64) != tets:
        raise ValueError(f"{SIZES} does not match the {tets} tets of the cubature")
    return LocalRows(sizes, arrays[ROWS], arrays[MODES])


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of these arrays, if there are any."""
    kinds: dict[str, type] = {SIZES: np.int32, ROWS: np.float32, MODES: np.float32}
    return kinds if any(name in arrays for name in kinds) else {}
