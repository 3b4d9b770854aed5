"""RigidFrames: shapes of a subspace in a frame that has moved rigidly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..mesh import apply_mass
from .affine_subspace import AffineSubspace

FloatArray = NDArray[np.float64]

#: Pairs of coordinates, x x, x y, x z, y y, y z, z z.
PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


class RigidFrames:
    """M-projections of rigidly moved shapes R (tau + U q) + t, at a cost independent of the mesh.

    With the rows U_a and tau_a of the coordinates a = x, y, z, the projection is
    sum_ab R_ab (U_a^T M U_b q + U_a^T M tau_b) + sum_a t_a U_a^T M 1, minus U^T M tau.

    Parameters
    ----------
    subspace : AffineSubspace
        Its products are computed once, with 6 n d^2 multiplications.
    """

    @single_threaded_blas
    def __init__(self, subspace: AffineSubspace) -> None:
        dimension = subspace.dimension
        rows = np.ascontiguousarray(subspace.basis.T)
        masses = apply_mass(subspace.mass, rows).reshape(dimension, -1, 3)
        columns, tau = rows.reshape(dimension, -1, 3), subspace.tau.reshape(-1, 3)
        #: (6, d, d) U_a^T M U_b of the pairs; of (b, a) they are the transposes
        self.modes = np.array([masses[:, :, a] @ columns[:, :, b].T for a, b in PAIRS])
        #: (3, 3, d) U_a^T M tau_b
        self.tau = np.array([[masses[:, :, a] @ tau[:, b] for b in range(3)] for a in range(3)])
        #: (3, d) U_a^T M 1
        self.ones = masses.sum(axis=1).T

    def coordinates(self, linear: FloatArray, shift: FloatArray, q: FloatArray) -> FloatArray:
        """Coordinates (d,) of the projection of `linear` (3, 3) times the shape, plus `shift` (3,).

        For the identity they are q.
        """
        d = len(q)
        moved = np.tensordot(linear - np.eye(3), self.tau[:, :, :d], axes=2)
        for (a, b), modes in zip(PAIRS, self.modes[:, :d, :d], strict=True):
            moved += linear[a, b] * (modes @ q)
            if a != b:
                moved += linear[b, a] * (q @ modes)
        return np.asarray(moved + shift @ self.ones[:, :d])
