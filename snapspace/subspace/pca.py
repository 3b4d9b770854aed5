"""pca, snapshot_pca: subspaces that fit given snapshots (paper, sec. 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import cholesky, solve_triangular
from scipy.sparse import csr_array

from ..arguments import as_numbers, is_number, require_count, require_type, shown, wrong_type
from ..blas import single_threaded_blas
from ..displacements import DisplacementRows, SnapshotGram, orthonormalise
from ..mesh import check_mass, mass_norm, shape_rows
from ..problem import PosingProblem, solutions_beyond_tau
from .affine_subspace import AffineSubspace
from .handle_products import HANDLE_WEIGHT, check_handle_weight, handle_products
from .principal import descending, scaled

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
    handle_weight: float = HANDLE_WEIGHT,
    gram: SnapshotGram | None = None,
) -> AffineSubspace:
    """The subspace through tau that fits the snapshots best (paper, sec. 5), above all at handles.

    The fit is best in the norm of the mass M plus `handle_weight` times the mass of the handles'
    vertices. The weight is large because handles are stiff: where few dimensions cannot represent a
    handle, a reduced solve distorts the rest of the shape to follow it, and the error can grow with
    d although the error at the handle is small in M. Interpolation problems have no handles, and
    use the norm of M.

    The fit uses converged and carried snapshots, see `Snapshots.usable`, and the solutions that the
    problem knows without solving, the poses of an interpolation. Snapshots are read in blocks, so
    memory holds only the basis and a block.

    Parameters
    ----------
    snapshots : Snapshots
    dimension, energy_fraction : int, float in (0, 1]
        Give exactly one: d, or the share of the snapshots' squared M-norm that the subspace must
        reach. The share selects the smallest d that reaches it.
    lumped : bool, default False
        Diagonal instead of consistent mass matrix.
    include_unconverged : bool, default False
        Also use snapshots whose solver stopped early.
    handle_weight : float, default 1000
        Not negative; 0 is the paper's PCA in M.
    gram : SnapshotGram, optional
        A Gram matrix of the problem, with the same lumping, to which all snapshots were added in
        order. Default: the one that the snapshots have. It is computed here if they have none or if
        masses are lumped.

    Returns
    -------
    AffineSubspace
        U^T M U = I up to rounding. Bases are nested. For every d, the squared error of the
        snapshots is the sum of `snapshot_energies` beyond d. Signs are fixed: the entry of a column
        that is largest in absolute value is positive.

    Raises
    ------
    ValueError
        Unless exactly one of dimension and energy_fraction is given; if the dimension exceeds the
        number of independent snapshots, no snapshot is usable, the weight is negative or not
        finite, or the Gram matrix is of other snapshots.
    """
    if not hasattr(snapshots, "usable"):  # this package knows no Snapshots
        cure = "give those of solve_snapshots; pca takes an array of shapes (k, 3n)"
        raise wrong_type("snapshot_pca", "snapshots", snapshots, cure)
    _check_size(dimension, energy_fraction)
    check_handle_weight(handle_weight, who="snapshot_pca")
    which = _which(snapshots, include_unconverged=include_unconverged)
    problem = snapshots.problem
    mass = problem.mass(lumped=lumped)
    usable, matrix = _usable_products(snapshots, which, mass, gram, lumped=lumped)
    displacements = usable.shifted(problem.base - problem.tau)
    heavy = None
    if handle_weight > 0 and isinstance(problem, PosingProblem):
        heavy = matrix + handle_weight * handle_products(problem, displacements)
    return _pca(
        displacements,
        problem.tau,
        mass,
        matrix,
        heavy=heavy,
        dimension=dimension,
        energy_fraction=energy_fraction,
    )


def spanned_dimension(snapshots: Snapshots) -> int:
    """The largest dimension of `snapshot_pca`: independent directions of usable snapshots.

    It nearly equals the number of snapshots, unless they depend on one parameter only. Snapshots
    between two poses lie near a curve: 34 between two Lions span 23 dimensions.

    Raises
    ------
    ValueError
        If no snapshot is usable, or if all are the reference shape.
    """
    problem, which = snapshots.problem, _which(snapshots, include_unconverged=False)
    mass = problem.mass()
    matrix = _usable_products(snapshots, which, mass, None, lumped=False)[1]
    return _rank(descending(matrix)[0], problem.tau, mass)


def _which(snapshots: Snapshots, *, include_unconverged: bool) -> NDArray[np.bool_]:
    """Which snapshots count, (k,); ValueError if none does."""
    which = np.ones(len(snapshots), bool) if include_unconverged else snapshots.usable
    if not which.any() and all(report.status == "not_finite" for report in snapshots.reports):
        raise ValueError(
            f"snapshot_pca: the energies of all {len(snapshots)} snapshots leave the range of "
            "numbers; use units in which the body's size and its moduli are nearer to 1"
        )
    if not which.any():
        raise ValueError(
            f"snapshot_pca: none of the {len(snapshots)} snapshots converged; allow more "
            "iterations, choose a smaller domain, or pass include_unconverged=True"
        )
    return which


def _usable_products(
    snapshots: Snapshots,
    which: NDArray[np.bool_],
    mass: csr_array,
    gram: SnapshotGram | None,
    *,
    lumped: bool,
) -> tuple[DisplacementRows, FloatArray]:
    """Displacements of some snapshots and of the known solutions, and their inner products."""
    problem = snapshots.problem
    known = solutions_beyond_tau(problem)[1] - problem.base
    usable = snapshots.displacements.select(which).followed_by(known)
    if gram is None and not lumped:
        gram = snapshots.gram
    if gram is None:
        products = SnapshotGram(mass, offset=problem.base - problem.tau)
        products.add(usable)
        return usable, products.matrix
    _check_gram(gram, mass, len(snapshots))
    products = gram.copy()
    products.add(known)
    rows = np.append(which, np.ones(len(known), bool))
    return usable, products.matrix[np.ix_(rows, rows)]


def pca(
    shapes: ArrayLike,
    tau: ArrayLike,
    mass: csr_array,
    *,
    dimension: int | None = None,
    energy_fraction: float | None = None,
    gram: FloatArray | None = None,
) -> AffineSubspace:
    """Mass-weighted PCA of any shapes by the method of snapshots (paper, sec. 5.2).

    Parameters
    ----------
    shapes : (k, 3n), one shape per row
    tau : array_like, (3n,), shape through which the subspace goes
    mass : csr_array, (n, n), scalar mass matrix
    dimension, energy_fraction
        As for `snapshot_pca` without handles; result and errors are the same as well.
    gram : (k, k), optional
        Inner products (x_i - tau)^T M (x_j - tau), if they are known.

    Raises
    ------
    ValueError
        For shapes, tau, a mass matrix or a Gram matrix of another shape or type.
    """
    _check_size(dimension, energy_fraction)
    tau = as_numbers("pca", "tau", tau)
    check_mass(mass, tau.size, who="pca")
    if tau.ndim != 1 or not np.isfinite(tau).all():
        raise ValueError(f"pca: tau has shape {tau.shape}, but must be (3n,), with finite numbers")
    checked = shape_rows(shapes, tau.size, who="pca")
    rows = DisplacementRows(np.subtract(checked, tau, order="C"), tau.size)
    if gram is None:
        products = SnapshotGram(mass)
        products.add(rows)
        gram = products.matrix
    elif (gram := as_numbers("pca", "gram", gram)).shape != (len(rows), len(rows)):
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
    heavy: FloatArray | None = None,
    dimension: int | None,
    energy_fraction: float | None,
) -> AffineSubspace:
    """The PCA, from displacements from tau and their Gram matrix, block by block.

    heavy : (k, k), inner products in the norm of the PCA, if that is not the mass
    """
    eigenvalues, vectors = descending(gram)
    rank = _rank(eigenvalues, tau, mass)
    count = rank if dimension is None else dimension
    if count > rank:
        raise ValueError(
            f"pca: dimension {count} exceeds the {rank} independent directions of "
            f"{len(eigenvalues)} usable snapshots; use more samples or a smaller dimension"
        )
    if heavy is None:
        energies, weights = eigenvalues, scaled(eigenvalues, vectors, count)
    else:
        weights = _orthonormal(scaled(*descending(heavy), count), gram)
        along = ((weights @ gram) ** 2).sum(axis=1)
        energies = np.append(along, max(0.0, gram.trace() - along.sum()))
    if energy_fraction is not None:
        held = np.cumsum(energies[:count]) / energies.sum()
        enough = int(np.searchsorted(held, energy_fraction * (1 - 1e-15))) + 1
        weights = weights[: min(rank, enough)]
    directions = displacements.combined(weights)
    orthonormalise(directions, mass)
    return AffineSubspace(tau, directions.T, mass, energies)


def _orthonormal(weights: FloatArray, gram: FloatArray) -> FloatArray:
    """The same nested spaces, with directions that are orthonormal in another inner product."""
    factor = cholesky(weights @ gram @ weights.T, lower=True)
    orthonormal: FloatArray = solve_triangular(factor, weights, lower=True)
    return orthonormal


def _check_size(dimension: int | None, energy_fraction: float | None) -> None:
    if (dimension is None) == (energy_fraction is None):
        raise ValueError("pca: give either dimension or energy_fraction")
    if dimension is not None:
        require_count("pca", "dimension", dimension, at_least=1)
    if energy_fraction is not None and not (
        is_number(energy_fraction) and 0 < energy_fraction <= 1
    ):
        raise ValueError(f"pca: energy_fraction is {shown(energy_fraction)}, but must be in (0, 1]")


def _rank(eigenvalues: FloatArray, tau: FloatArray, mass: csr_array) -> int:
    """Number of directions above rounding errors; ValueError if there are none."""
    count = len(eigenvalues)
    # Eigenvalues below this are rounding noise of the largest one.
    noise = count * np.finfo(float).eps * eigenvalues[0]
    # Displacements of equal poses are rounding errors of positions.
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
    cure = "give SnapshotGram.of(problem) with all snapshots added"
    require_type("snapshot_pca", "gram", gram, SnapshotGram, cure)
    if len(gram) != samples:
        raise ValueError(
            f"snapshot_pca: the Gram matrix has {len(gram)} snapshots, but there are {samples}; "
            "add all of them, in order"
        )
    same = gram.mass is mass or (
        np.array_equal(gram.mass.indptr, mass.indptr) and np.array_equal(gram.mass.data, mass.data)
    )
    if not same:
        raise ValueError(
            "snapshot_pca: the Gram matrix has another mass matrix; make it with "
            "SnapshotGram.of(problem, lumped=...) and the same lumping"
        )
