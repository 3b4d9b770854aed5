"""handle_products: inner products of displacements, with the mass of the handles only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import is_finite, shown
from ..blas import single_threaded_blas
from ..displacements import DisplacementRows
from ..problem import PosingProblem

FloatArray = NDArray[np.float64]

#: Chosen on five problems, and tested on seven others (docs/notes/basis-order.md). With 100, some
#: errors on the five still grow with d.
HANDLE_WEIGHT = 1000.0


@single_threaded_blas
def handle_products(problem: PosingProblem, displacements: DisplacementRows) -> FloatArray:
    """The matrix (k, k) of products d_i^T M_h d_j of displacements (k, 3n).

    M_h is the lumped mass at the vertices of handles, and zero elsewhere. One block of columns is
    in memory at a time.
    """
    lumped = np.zeros_like(problem.mesh.vertex_masses)
    lumped[problem.pinned] = problem.mesh.vertex_masses[problem.pinned]
    roots = np.repeat(np.sqrt(lumped), 3)
    products = np.zeros((len(displacements), len(displacements)))
    for columns, block in displacements.blocks():
        inside = np.flatnonzero(roots[columns])
        if len(inside):
            part = block[:, inside] * roots[columns][inside]
            products += part @ part.T
    return products


def check_handle_weight(weight: float, *, who: str) -> None:
    """ValueError for a weight that is not a number, negative or not finite."""
    if not (is_finite(weight) and weight >= 0):
        raise ValueError(
            f"{who}: handle_weight is {shown(weight)}, but must be finite and not negative"
        )
