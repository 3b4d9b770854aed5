"""Displacement gradients of modes in single tets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

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
        points = mesh.vertices[corners]
        edges = points[:, 1:] - points[:, :1]  # (b, j, 3)
        inverse = np.linalg.inv(edges)  # (b, 3, j): column j is the gradient of shape function j
        nodal = modes[corners]
        moved = (nodal[:, 1:] - nodal[:, :1]).reshape(len(corners), 3, 3 * d)
        gradients = (inverse @ moved).reshape(-1, 3, 3, d)  # (b, x, u, d)
        rows[begin : begin + _BLOCK] = gradients.swapaxes(1, 2).reshape(-1, 9, d)
    return rows
