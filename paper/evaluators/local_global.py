"""The local/global solver of a clustered ARAP energy, in reduced coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from snapspace.reduction import HandleQuadric

from .rotation_clusters import ClusteredEnergy

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class LocalGlobal:
    """Where the iteration ended: coordinates (d,), and how many steps it took."""

    q: FloatArray
    steps: int


def local_global(
    energy: ClusteredEnergy,
    handles: HandleQuadric,
    offsets: FloatArray,
    start: FloatArray,
    *,
    tolerance: float = 1e-7,
    most: int = 10_000,
) -> LocalGlobal:
    """Minimises the clustered energy and the handles' from `start` (d,).

    The best rotation of each cluster, then the best coordinates for these rotations by one
    factorised system, in turn (Jacobson et al. 2012, sec. 4): the objective never grows. Ends when
    a step is below the tolerance times the distance from rest.

    offsets : (h, 3, 4) of the handles, as for `HandleQuadric`
    """
    rows = energy.clusters.rows.astype(np.float64).reshape(-1, energy.dimension)
    weights = np.repeat(energy.clusters.weights, 9)
    matrix = energy.spread + rows.T @ (weights[:, None] * rows) + handles.K
    pull = np.einsum("hik,hk->i", handles.L, offsets.reshape(len(offsets), 12))
    factor = cho_factor(matrix)
    q, taken, step = start, 0, np.inf
    while taken < most and step > tolerance * float(np.linalg.norm(q)):
        rotations = nearest_rotations(np.eye(3) + (rows @ q).reshape(-1, 3, 3))
        wanted = (rotations - np.eye(3)).ravel()
        after: FloatArray = cho_solve(factor, rows.T @ (weights * wanted) + pull)
        step = float(np.linalg.norm(after - q))
        q, taken = after, taken + 1
    return LocalGlobal(q, taken)


def nearest_rotations(matrices: FloatArray) -> FloatArray:
    """The rotations (k, 3, 3) nearest to matrices, without reflections."""
    left, _, right = np.linalg.svd(matrices)
    left[:, :, 2] *= np.sign(np.linalg.det(left @ right))[:, None]
    rotations: FloatArray = left @ right
    return rotations
