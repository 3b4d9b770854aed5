"""Affine subspaces of shapes, and the best one for given snapshots (paper, sec. 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import cholesky, eigh, solve_triangular
from scipy.sparse import csr_array

from . import _core as core
from .blas import single_threaded_blas
from .mesh import apply_mass, mass_gram, mass_norm
from .problem import solutions_beyond_tau
from .snapshots import Snapshots

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class AffineSubspace:
    """The shapes tau + U q (paper, eq. 4).

    tau : (3n,) reference shape, x0 y0 z0 x1 ...
    basis : (3n, d) U, with M-orthonormal columns, best first
    mass : (n, n) scalar mass matrix M of the reference shape
    eigenvalues : (k,) of the snapshots' Gram matrix, descending; those beyond d are the squared
    error on the snapshots
    """

    tau: FloatArray
    basis: FloatArray
    mass: csr_array
    eigenvalues: FloatArray

    @property
    def dimension(self) -> int:
        """d."""
        return int(self.basis.shape[1])

    @property
    def lumped(self) -> bool:
        """Whether the mass matrix is diagonal."""
        return bool(self.mass.nnz == self.mass.shape[0])

    @property
    def energy_fraction(self) -> float:
        """Share of the snapshots' squared M-norm that the subspace holds (paper, sec. 5.2)."""
        return float(self.eigenvalues[: self.dimension].sum() / self.eigenvalues.sum())

    def leading(self, dimension: int) -> AffineSubspace:
        """The first columns: the best subspace of that dimension for the same snapshots."""
        _check_dimension(dimension, self.dimension)
        basis = np.asfortranarray(self.basis[:, :dimension])
        return AffineSubspace(self.tau, basis, self.mass, self.eigenvalues)

    @single_threaded_blas
    def coordinates(self, shapes: ArrayLike) -> FloatArray:
        """q = U^T M (x - tau) of the M-projection of shapes (3n,) or (3n, k): (d,) or (d, k)."""
        x = np.asarray(shapes, np.float64)
        offset = x - (self.tau if x.ndim == 1 else self.tau[:, None])
        coordinates: FloatArray = self.basis.T @ apply_mass(self.mass, offset)
        return coordinates

    def shape(self, q: ArrayLike) -> FloatArray:
        """tau + U q, (3n,), for coordinates (d,)."""
        return core.reconstruct(self.tau, self.basis.T, np.asarray(q, np.float64))


def snapshot_pca(
    snapshots: Snapshots,
    *,
    dimension: int | None = None,
    energy_fraction: float | None = None,
    lumped: bool = False,
    include_unconverged: bool = False,
) -> AffineSubspace:
    """Subspace through tau that fits the snapshots best in the M-norm (paper, sec. 5).

    Solutions that the problem knows without solving, the poses of an interpolation, count as
    snapshots.

    Parameters
    ----------
    snapshots : Snapshots
    dimension, energy_fraction : int, float in (0, 1]
        Give one: d, or the smallest d whose eigenvalues hold that fraction of their sum.
    lumped : bool, default False
        Diagonal instead of consistent mass matrix.
    include_unconverged : bool, default False
        Also use snapshots whose solver stopped early.

    Returns
    -------
    AffineSubspace
        U^T M U = I to rounding; the bases are nested; the squared errors of the snapshots add up
        to the eigenvalues beyond d. Signs are fixed: the largest entry of a column is positive.

    Raises
    ------
    ValueError
        If no or both sizes are given, the dimension exceeds the number of independent snapshots,
        or no snapshot is usable.
    """
    usable = snapshots if include_unconverged else snapshots.select(snapshots.converged)
    if len(usable) == 0:
        raise ValueError(
            f"snapshot_pca: none of the {len(snapshots)} snapshots converged; allow more "
            "iterations, a smaller domain, or include_unconverged=True"
        )
    problem = snapshots.problem
    _, known = solutions_beyond_tau(problem)
    return pca(
        np.hstack([usable.shapes, known.T]),
        problem.tau,
        problem.mass(lumped=lumped),
        dimension=dimension,
        energy_fraction=energy_fraction,
    )


@single_threaded_blas
def pca(
    shapes: FloatArray,
    tau: FloatArray,
    mass: csr_array,
    *,
    dimension: int | None = None,
    energy_fraction: float | None = None,
) -> AffineSubspace:
    """Mass-weighted PCA of any shapes by the method of snapshots (paper, sec. 5.2).

    Parameters
    ----------
    shapes : (3n, k), one shape per column
    tau : (3n,), the shape that the subspace goes through
    mass : csr_array, (n, n), scalar mass matrix
    dimension, energy_fraction
        As for `snapshot_pca`, and so are the result and the errors.
    """
    if (dimension is None) == (energy_fraction is None):
        raise ValueError("pca: give either dimension or energy_fraction")
    displacements = shapes - tau[:, None]
    weighted = apply_mass(mass, displacements)
    eigenvalues, vectors = eigh(displacements.T @ weighted)
    eigenvalues, vectors = np.maximum(eigenvalues[::-1], 0.0), vectors[:, ::-1]
    # Eigenvalues below this are rounding noise of the largest one.
    noise = len(eigenvalues) * np.finfo(float).eps * eigenvalues[0]
    # So are displacements that are nothing but rounding of positions: those of equal poses.
    centered = (tau.reshape(-1, 3) - tau.reshape(-1, 3).mean(axis=0)).reshape(-1)
    noise = max(noise, len(eigenvalues) * (1e-13 * mass_norm(mass, centered)) ** 2)
    rank = int((eigenvalues > noise).sum())
    if rank == 0:
        raise ValueError(
            f"pca: all {len(eigenvalues)} snapshots equal the reference shape, so there is no "
            "direction to span; poses must differ by more than a rigid motion"
        )
    if energy_fraction is not None:
        if not 0 < energy_fraction <= 1:
            raise ValueError(f"pca: energy_fraction is {energy_fraction}, but must be in (0, 1]")
        held = np.cumsum(eigenvalues[:rank]) / eigenvalues.sum()
        dimension = min(rank, int(np.searchsorted(held, energy_fraction * (1 - 1e-15))) + 1)
    assert dimension is not None
    if dimension > rank:
        raise ValueError(
            f"pca: dimension {dimension} exceeds the {rank} independent directions of "
            f"{len(eigenvalues)} usable snapshots; take more samples or a smaller dimension"
        )
    _check_dimension(dimension, rank)
    basis = displacements @ (vectors[:, :dimension] / np.sqrt(eigenvalues[:dimension]))
    basis = _orthonormalised(basis, mass)
    signs = np.sign(basis[np.abs(basis).argmax(axis=0), np.arange(dimension)])
    return AffineSubspace(tau, np.asfortranarray(basis * signs), mass, eigenvalues)


def _orthonormalised(basis: FloatArray, mass: csr_array) -> FloatArray:
    """Restores U^T M U = I by two Cholesky-QR passes; they are triangular, so bases stay nested.

    The Gram matrix squares the condition number: a direction with eigenvalue lambda_i comes out
    orthonormal only to eps * lambda_1 / lambda_i, which is far from 1e-12 for the last of forty.
    """
    for _ in range(2):
        factor = cholesky(mass_gram(mass, basis, basis))
        basis = solve_triangular(factor, basis.T, trans="T").T
    error = float(np.abs(mass_gram(mass, basis, basis) - np.eye(basis.shape[1])).max())
    if error > 1e-10:
        raise ValueError(
            f"pca: the basis is orthonormal only to {error:.1e}; the last directions are noise, "
            "take a smaller dimension"
        )
    return basis


def _check_dimension(dimension: int, largest: int) -> None:
    if not 1 <= dimension <= largest:
        raise ValueError(
            f"AffineSubspace: dimension {dimension} is not between 1 and {largest}; a larger one "
            "takes more snapshots"
        )
