"""Displacement gradients of modes in single tets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..mesh import TetMesh

FloatArray = NDArray[np.float64]

#: Tets at a time: what is in double precision stays small.
_BLOCK = 2048


def displacement_gradients(
    mesh: TetMesh, basis: FloatArray, tets: NDArray[np.int32]
) -> NDArray[np.float32]:
    """d u_a / d x_b of every mode in tets (r,): (r, 9, d) float32, entry 3 a + b of the second.

    The rows times q are the displacement gradient of U q, which is constant in a tet. Differences
    of nodal values come first: sums over the four vertices would lose digits on slivers.
    """
    d = basis.shape[1]
    modes = basis.reshape(-1, 3, d)
    rows = np.empty((len(tets), 9, d), np.float32)
    for begin in range(0, len(tets), _BLOCK):
        corners = mesh.tets[tets[begin : begin + _BLOCK]]
        block = core.displacement_rows(mesh.vertices[corners], modes[corners])
        rows[begin : begin + _BLOCK] = block
    return rows
