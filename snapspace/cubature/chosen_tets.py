"""Checks of the tets that a cubature is given."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require_type
from ..energy import ShellMaterial
from ..material import Material
from .local_rows import LocalRows

FloatArray = NDArray[np.float64]


def check_chosen(
    tets: NDArray[np.int32],
    weights: FloatArray,
    rows: NDArray[np.float32] | LocalRows,
    material: Material | ShellMaterial | None,
    *,
    who: str,
) -> None:
    """Raises ValueError unless sizes match and all weights are positive and finite.

    A material of None is not checked.
    """
    require_type(who, "weights", weights, np.ndarray, "give an array (r,)")
    r = len(tets)
    shape = (rows.tets, 9, rows.dimension) if isinstance(rows, LocalRows) else rows.shape
    if r == 0 or weights.shape != (r,) or len(shape) != 3 or shape[:2] != (r, 9):
        raise ValueError(
            f"{who}: {r} tets need weights ({r},) and rows ({r}, 9, d), got arrays of "
            f"shapes {weights.shape} and {shape}"
        )
    bad = np.flatnonzero(~(np.isfinite(weights) & (weights > 0)))
    if bad.size:
        raise ValueError(
            f"{who}: the weight of tet {tets[bad[0]]} is {weights[bad[0]]}, but weights "
            "must be positive"
        )
    if material is not None:
        material.check_tets(r, who)


def check_in_mesh(tets: NDArray[np.int32], count: int, *, who: str) -> None:
    """Raises ValueError unless the mesh has all of these tets."""
    if tets.dtype.kind not in "iu":
        raise ValueError(f"{who}: tets must be whole numbers, got {tets.dtype}")
    if len(tets) and not 0 <= tets.min() <= tets.max() < count:
        raise ValueError(f"{who}: tets must be between 0 and {count - 1}")
