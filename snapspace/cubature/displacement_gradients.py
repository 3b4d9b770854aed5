"""Displacement gradients of modes in single tets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..mesh import TetMesh

FloatArray = NDArray[np.float64]


def displacement_gradients(
    mesh: TetMesh, basis: FloatArray, tets: NDArray[np.int32], *, threads: int | None = None
) -> NDArray[np.float32]:
    """d u_a / d x_b of every mode in tets (r,): (r, 9, d) float32, entry 3 a + b of the second.

    The rows times q are the displacement gradient of U q, which is constant in a tet. Differences
    of nodal values come first: sums over the four vertices would lose digits on slivers.
    """
    modes = np.ascontiguousarray(basis.T)
    rows: NDArray[np.float32] = core.mode_gradients(
        mesh.vertices, modes, mesh.tets[tets], threads=threads or 0
    )
    return rows
