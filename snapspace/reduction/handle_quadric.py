"""The handle energy in reduced coordinates (paper, sec. 6.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_coordinates, as_numbers, require_dimension
from ..blas import single_threaded_blas
from ..problem import PosingProblem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HandleQuadric:
    """Eq. (2) at the shape rest + U q as a quadratic form in q and the handles' offsets D_h.

    value = q^T K q - 2 sum_h (L_h vec D_h) . q + sum_h tr(D_h S_h D_h^T), where D_h (3, 4) maps
    (rest - centroid, 1) to the wanted displacement, [R - I | t] for a rigid motion. Any affine
    motion is exact.

    K : (d, d) float64, symmetric
    L : (h, d, 12) float64, columns are the entries of D_h row by row
    S : (h, 4, 4) float64
    """

    K: FloatArray
    L: FloatArray
    S: FloatArray

    def __repr__(self) -> str:
        return f"HandleQuadric(dimension {len(self.K)}, {len(self.L)} handles)"

    def value(self, q: ArrayLike, offsets: ArrayLike) -> float:
        """Handle energy at coordinates (d,) for offsets (h, 3, 4); ValueError otherwise."""
        q = as_coordinates("HandleQuadric", q, len(self.K))
        offsets = as_numbers("HandleQuadric", "offsets", offsets)
        if offsets.shape != (len(self.L), 3, 4):
            raise ValueError(
                f"HandleQuadric: offsets have shape {offsets.shape}, but must be "
                f"({len(self.L)}, 3, 4), as PosingProblem.offsets has them"
            )
        linear = np.einsum("hik,hk->i", self.L, offsets.reshape(len(offsets), 12))
        constant = np.einsum("hra,hab,hrb->", offsets, self.S, offsets)
        return float(q @ self.K @ q - 2.0 * linear @ q + constant)

    def leading(self, dimension: int) -> HandleQuadric:
        """The form on the first coordinates; ValueError unless there are that many."""
        require_dimension("HandleQuadric", dimension, len(self.K))
        K = np.ascontiguousarray(self.K[:dimension, :dimension])
        return HandleQuadric(K, np.ascontiguousarray(self.L[:, :dimension]), self.S)


@single_threaded_blas
def handle_quadric(problem: PosingProblem, subspace: AffineSubspace) -> HandleQuadric:
    """The quadratic form of a problem's handles on a subspace attached to the rest shape.

    Equal to `problem.handle_energy(subspace.shape(q), offsets)` for all q and all affine offsets.
    """
    d = subspace.dimension
    modes = subspace.basis.reshape(-1, 3, d)
    vertices, masses = problem.mesh.vertices, problem.mesh.vertex_masses
    K, L, S = np.zeros((d, d)), [], []
    for handle, center in zip(problem.handles, problem.centroids, strict=True):
        weights = problem.stiffness * masses[handle.vertices]
        local = modes[handle.vertices]  # (k, 3, d)
        arms = np.column_stack([vertices[handle.vertices] - center, np.ones(len(weights))])
        flat = local.reshape(-1, d)
        K += flat.T @ (np.repeat(weights, 3)[:, None] * flat)
        weighted_arms = weights[:, None] * arms
        L.append(np.einsum("jri,ja->ira", local, weighted_arms, optimize=True).reshape(d, 12))
        S.append(arms.T @ weighted_arms)
    return HandleQuadric((K + K.T) / 2, np.array(L), np.array(S))
