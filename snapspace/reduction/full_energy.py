"""FullEnergy: the elastic energy of all tets on a subspace, at the cost of the mesh."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import bsr_array, csr_array

from .. import _core as core
from ..blas import single_threaded_blas
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]

#: Columns of a Hessian that are made together. Results do not depend on the number of threads,
#: since each block of columns is made by one of them.
BLOCK = 64


@dataclass(frozen=True, eq=False)
class FullEnergy:
    """sum_k w_k E_k(tau + U q) over all tets, for subspaces of any dimension.

    Nothing is precomputed. A gradient costs one evaluation on the mesh and 6 n d multiply-adds; a
    Hessian U^T H U costs 3 n d^2 more. Memory is that of the basis.

    parts : energies E_k of displacements from their own rest shapes
    weights : (k,) w_k
    origins : (k, 3n), tau relative to these rest shapes
    basis : (3n, d) U
    threads : int, 0 for all; they share the columns of a Hessian
    """

    parts: Sequence[core.ElasticEnergy]
    weights: FloatArray
    origins: FloatArray
    basis: FloatArray
    threads: int = 0

    @property
    def dimension(self) -> int:
        """d."""
        return int(self.basis.shape[1])

    def value(self, q: ArrayLike) -> float:
        """Energy at q (d,)."""
        return self.value_and_gradient(q)[0]

    @single_threaded_blas
    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at q and its gradient (d,), U^T of the full gradient."""
        move = self.basis @ np.asarray(q, np.float64)
        value, gradient = 0.0, np.zeros(len(move))
        for part, weight, origin in zip(self.parts, self.weights, self.origins, strict=True):
            one, slope = part.value_and_gradient(origin + move)
            value += weight * one
            gradient += weight * slope
        return value, self.basis.T @ gradient

    def hessian(
        self, q: ArrayLike, *, projection: core.Projection = core.Projection.none
    ) -> FloatArray:
        """Hessian at q, (d, d); a projection makes those of the tets positive semidefinite."""
        blocks = self._blocks(np.asarray(q, np.float64), projection)
        pieces = [slice(i, i + BLOCK) for i in range(0, self.dimension, BLOCK)]
        with ThreadPoolExecutor(self.threads or None) as pool:
            columns = list(pool.map(lambda piece: self._columns(blocks, piece), pieces))
        hessian = np.hstack(columns)
        symmetric: FloatArray = (hessian + hessian.T) / 2.0
        return symmetric

    def leading(self, dimension: int) -> FullEnergy:
        """The energy on the first coordinates."""
        return replace(self, basis=self.basis[:, :dimension])

    @single_threaded_blas
    def _columns(self, blocks: csr_array, piece: slice) -> FloatArray:
        product: FloatArray = self.basis.T @ (blocks @ np.ascontiguousarray(self.basis[:, piece]))
        return product

    @single_threaded_blas
    def _blocks(self, q: FloatArray, projection: core.Projection) -> csr_array:
        """Hessian (3n, 3n) of the full energy."""
        move = self.basis @ q
        total: csr_array | None = None
        for part, weight, origin in zip(self.parts, self.weights, self.origins, strict=True):
            starts, columns, values = part.hessian_blocks(origin + move, projection=projection)
            size = len(move)
            one = weight * bsr_array((values, columns, starts), shape=(size, size)).tocsr()
            total = one if total is None else total + one
        assert total is not None
        return total


@dataclass(frozen=True, eq=False)
class FullBlends:
    """The energies of several poses on a subspace, of all tets: blended as their weighted sum.

    energies : FullEnergy of all poses, with equal weights
    """

    energies: FullEnergy

    @property
    def dimension(self) -> int:
        """d."""
        return self.energies.dimension

    def at(self, weights: ArrayLike) -> FullEnergy:
        """The energy for weights (poses,); poses without weight cost nothing."""
        every, w = self.energies, np.asarray(weights, np.float64)
        own = w != 0.0
        parts = [part for part, used in zip(every.parts, own, strict=True) if used]
        return replace(every, parts=parts, weights=w[own], origins=every.origins[own])

    def leading(self, dimension: int) -> FullBlends:
        """The energies on the first coordinates."""
        return FullBlends(self.energies.leading(dimension))


def full_energy(
    problem: PosingProblem, subspace: AffineSubspace, *, threads: int | None = None
) -> FullEnergy:
    """The elastic energy of all tets on a subspace attached to the rest shape."""
    origin = (subspace.tau - problem.base)[None]
    return FullEnergy([problem.energy.core], np.ones(1), origin, subspace.basis, threads or 0)


def full_blends(
    problem: InterpolationProblem, subspace: AffineSubspace, *, threads: int | None = None
) -> FullBlends:
    """The energies of all poses on a subspace attached to the mean shape."""
    count = len(problem.poses)
    parts = [problem.pose_energy(k) for k in range(count)]
    origins = subspace.tau - problem.pose_shapes
    weights = np.full(count, 1.0 / count)
    return FullBlends(FullEnergy(parts, weights, origins, subspace.basis, threads or 0))


def not_stored(who: str) -> ValueError:
    """The error of files and pages, which cannot hold the energy of all tets."""
    return ValueError(
        f"{who}: the model has the energy of all tets, which is for experiments; make one with "
        "reduce(..., energy='cubature') or energy='exact'"
    )
