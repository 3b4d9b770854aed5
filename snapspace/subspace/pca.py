"""pca, snapshot_pca: the best subspace for given snapshots (paper, sec. 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.sparse import csr_array

from ..blas import single_threaded_blas
from ..displacements import DisplacementRows, SnapshotGram, orthonormalise
from ..mesh import mass_norm
from ..problem import solutions_beyond_tau
from .affine_subspace import AffineSubspace, check_dimension

if TYPE_CHECKING:
    from ..snapshots import Snapshots

FloatArray = NDArray[np.float64]


def snapshot_pca(
    snapshots: Snapshots,
    *,
    dimension: int | None = None,
    energy_fraction: float | None = None,
    lumped: bool = False,
    include_unconverged: bool = False,
    gram: SnapshotGram | None = None,
) -> AffineSubspace:
    """Subspace through tau that fits the snapshots best in the M-norm (paper, sec. 5).

    Those that are converged or carried count, see `Snapshots.usable`, and so do the solutions that
    the problem knows without solving, the poses of an interpolation. Memory: the basis and blocks;
    the snapshots stay where they are.

    Parameters
    ----------
    snapshots : Snapshots
    dimension, energy_fraction : int, float in (0, 1]
        Give one: d, or the smallest d whose eigenvalues hold that fraction of their sum.
    lumped : bool, default False
        Diagonal instead of consistent mass matrix.
    include_unconverged : bool, default False
        Also use snapshots whose solver stopped early.
    gram : SnapshotGram, optional
        Of the problem, with the same lumping, to which all the snapshots were added in their order.
        Default: that of the snapshots, or computed here where they have none or masses are lumped.

    Returns
    -------
    AffineSubspace
        U^T M U = I to rounding; the bases are nested; the squared errors of the snapshots add up
        to the eigenvalues beyond d. Signs are fixed: the largest entry of a column is positive.

    Raises
    ------
    ValueError
        If no or both sizes are given, the dimension exceeds the number of independent snapshots,
        no snapshot is usable, or the Gram matrix is of other snapshots.
    """
    _check_size(dimension, energy_fraction)
    which = np.ones(len(snapshots), bool) if include_unconverged else snapshots.usable
    if not which.any():
        raise ValueError(
            f"snapshot_pca: none of the {len(snapshots)} snapshots converged; allow more "
            "iterations, a smaller domain, or include_unconverged=True"
        )
    problem = snapshots.problem
    known = solutions_beyond_tau(problem)[1] - problem.base
    mass, offset = problem.mass(lumped=lumped), problem.base - problem.tau
    usable = snapshots.displacements.select(which).followed_by(known)
    if gram is None and not lumped:
        gram = snapshots.gram
    if gram is None:
        products = SnapshotGram(mass, offset=offset)
        products.add(usable)
        matrix = products.matrix
    else:
        _check_gram(gram, mass, len(snapshots))
        products = gram.copy()
        products.add(known)
        rows = np.append(which, np.ones(len(known), bool))
        matrix = products.matrix[np.ix_(rows, rows)]
    return _pca(
        usable.shifted(offset),
        problem.tau,
        mass,
        matrix,
        dimension=dimension,
        energy_fraction=energy_fraction,
    )


def pca(
    shapes: FloatArray,
    tau: FloatArray,
    mass: csr_array,
    *,
    dimension: int | None = None,
    energy_fraction: float | None = None,
    gram: FloatArray | None = None,
) -> AffineSubspace:
    """Mass-weighted PCA of any shapes by the method of snapshots (paper, sec. 5.2).

    Parameters
    ----------
    shapes : (3n, k), one shape per column
    tau : (3n,), the shape that the subspace goes through
    mass : csr_array, (n, n), scalar mass matrix
    dimension, energy_fraction
        As for `snapshot_pca`, and so are the result and the errors.
    gram : (k, k), optional
        Inner products (x_i - tau)^T M (x_j - tau), if they are known.
    """
    _check_size(dimension, energy_fraction)
    rows = DisplacementRows(np.subtract(shapes.T, tau, order="C"), tau.size)
    if gram is None:
        products = SnapshotGram(mass)
        products.add(rows)
        gram = products.matrix
    elif gram.shape != (len(rows), len(rows)):
        raise ValueError(
            f"pca: the Gram matrix has shape {gram.shape}, but {len(rows)} shapes need "
            f"({len(rows)}, {len(rows)})"
        )
    return _pca(rows, tau, mass, gram, dimension=dimension, energy_fraction=energy_fraction)


@single_threaded_blas
def _pca(
    displacements: DisplacementRows,
    tau: FloatArray,
    mass: csr_array,
    gram: FloatArray,
    *,
    dimension: int | None,
    energy_fraction: float | None,
) -> AffineSubspace:
    """From displacements from tau and their Gram matrix, block by block."""
    eigenvalues, vectors = eigh(gram)
    eigenvalues, vectors = np.maximum(eigenvalues[::-1], 0.0), vectors[:, ::-1]
    rank = _rank(eigenvalues, tau, mass)
    if energy_fraction is not None:
        held = np.cumsum(eigenvalues[:rank]) / eigenvalues.sum()
        dimension = min(rank, int(np.searchsorted(held, energy_fraction * (1 - 1e-15))) + 1)
    assert dimension is not None
    if dimension > rank:
        raise ValueError(
            f"pca: dimension {dimension} exceeds the {rank} independent directions of "
            f"{len(eigenvalues)} usable snapshots; take more samples or a smaller dimension"
        )
    check_dimension(dimension, rank)
    weights = (vectors[:, :dimension] / np.sqrt(eigenvalues[:dimension])).T
    directions = displacements.combined(weights)
    orthonormalise(directions, mass)
    for direction in directions:
        direction *= np.sign(direction[np.abs(direction).argmax()])
    return AffineSubspace(tau, directions.T, mass, eigenvalues)


def _check_size(dimension: int | None, energy_fraction: float | None) -> None:
    if (dimension is None) == (energy_fraction is None):
        raise ValueError("pca: give either dimension or energy_fraction")
    if energy_fraction is not None and not 0 < energy_fraction <= 1:
        raise ValueError(f"pca: energy_fraction is {energy_fraction}, but must be in (0, 1]")


def _rank(eigenvalues: FloatArray, tau: FloatArray, mass: csr_array) -> int:
    """How many directions are more than rounding; ValueError if none is."""
    count = len(eigenvalues)
    # Eigenvalues below this are rounding noise of the largest one.
    noise = count * np.finfo(float).eps * eigenvalues[0]
    # So are displacements that are nothing but rounding of positions: those of equal poses.
    centered = (tau.reshape(-1, 3) - tau.reshape(-1, 3).mean(axis=0)).reshape(-1)
    noise = max(noise, count * (1e-13 * mass_norm(mass, centered)) ** 2)
    rank = int((eigenvalues > noise).sum())
    if rank == 0:
        raise ValueError(
            f"pca: all {count} snapshots equal the reference shape, so there is no "
            "direction to span; poses must differ by more than a rigid motion"
        )
    return rank


def _check_gram(gram: SnapshotGram, mass: csr_array, samples: int) -> None:
    if len(gram) != samples:
        raise ValueError(
            f"snapshot_pca: the Gram matrix is of {len(gram)} snapshots, but there are {samples}; "
            "add all of them in their order"
        )
    same = gram.mass is mass or (
        np.array_equal(gram.mass.indptr, mass.indptr) and np.array_equal(gram.mass.data, mass.data)
    )
    if not same:
        raise ValueError(
            "snapshot_pca: the Gram matrix has another mass matrix; make it by "
            "SnapshotGram.of(problem, lumped=...) with the same lumping"
        )
