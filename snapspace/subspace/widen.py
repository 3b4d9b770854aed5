"""widen: more dimensions from the same snapshots, by combinations of their parts."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers, require_count, wrong_type
from ..blas import single_threaded_blas
from ..displacements import BLOCK, orthonormalise
from ..problem import PosingProblem
from .affine_subspace import AffineSubspace, check_subspace
from .handle_products import HANDLE_WEIGHT, check_handle_weight
from .handle_windows import handle_windows
from .principal import descending, scaled

if TYPE_CHECKING:
    from ..snapshots import Snapshots

FloatArray = NDArray[np.float64]

#: Number of leading directions that are split. With 64 the error on an armadillo is 0.0052, with
#: 120 it is 0.0041 (120 samples, d = 180).
TAKEN_APART = 96
#: Number of vertices in the fit, evenly spaced. With all of 16,000 vertices the fit is no better.
VERTICES = 8192


def widen(
    subspace: AffineSubspace,
    snapshots: Snapshots,
    *,
    dimension: int,
    windows: ArrayLike | None = None,
    handle_weight: float = HANDLE_WEIGHT,
) -> AffineSubspace:
    """The subspace that fits snapshots and parts of snapshots best.

    A handle deforms the body mostly near itself. So the deformation near one handle in one snapshot
    can be combined with the deformation near another handle in another snapshot, although no
    snapshot has both. Windows are smooth weights of the vertices that split snapshots into such
    parts. The subspace is the PCA of the snapshots and of their products with every window. It may
    have more dimensions than there are snapshots, and serves as well as one from several times as
    many.

    Parameters
    ----------
    subspace : AffineSubspace
        From `snapshot_pca`, best with all dimensions of the snapshots, up to 256. Its directions
        replace the snapshots: each one is weighted by their energy along it, and the 96 leading
        ones are split.
    snapshots : Snapshots
        The snapshots that it was made of, of a posing problem.
    dimension : int
        d; fewer if there are not as many independent directions.
    windows : array_like, (r, n), default handle_windows(problem)
        Weights of the vertices; they should add up to one.
    handle_weight : float, default 1000
        As for `snapshot_pca`. Masses are lumped in the norm of the fit.

    Returns
    -------
    AffineSubspace
        U^T M U = I up to rounding. Bases are nested. For every d, the squared error of the
        snapshots is the sum of `snapshot_energies` beyond d. Signs are fixed: the entry of a column
        that is largest in absolute value is positive.

    Raises
    ------
    ValueError
        For arguments of wrong types; if the problem has no handles; if the subspace is of another
        mesh or has no energies; for windows of another shape or not finite, a dimension below 1, or
        a weight that is negative or not finite.
    """
    check_subspace(subspace, "widen")
    if not hasattr(snapshots, "usable"):  # this package knows no Snapshots
        raise wrong_type("widen", "snapshots", snapshots, "give subspace, snapshots")
    problem = snapshots.problem
    if not isinstance(problem, PosingProblem):
        raise ValueError(
            f"widen: snapshots are of {problem!r}, but only handles can split snapshots; use the "
            "subspace of snapshot_pca as it is"
        )
    if subspace.tau.size != problem.tau.size:
        raise ValueError(
            f"widen: the subspace is of {subspace.tau.size // 3} vertices, but the snapshots are "
            f"of {problem.mesh!r}; give the subspace that was made of them"
        )
    energies = subspace.snapshot_energies
    if energies is None:
        raise ValueError(
            "widen: the subspace has no energies, so its directions cannot be weighted; give one "
            "of snapshot_pca"
        )
    check_handle_weight(handle_weight, who="widen")
    dimension = require_count("widen", "dimension", dimension, at_least=1)
    if windows is None:
        windows = handle_windows(problem)
    parts = _checked(windows, len(problem.mesh.vertices))
    weights = problem.mesh.vertex_masses.copy()
    weights[problem.pinned] *= 1.0 + handle_weight
    basis = _fitted(subspace, energies, parts, weights, dimension)
    wide = AffineSubspace(subspace.tau, basis.T, subspace.mass)
    rows = snapshots.displacements.select(snapshots.usable).shifted(problem.base - subspace.tau)
    held = (wide.row_coordinates(rows) ** 2).sum(axis=0)
    left = max(0.0, float(energies.sum() - held.sum()))
    return replace(wide, snapshot_energies=np.append(held, left))


@single_threaded_blas
def _fitted(
    subspace: AffineSubspace,
    energies: FloatArray,
    windows: FloatArray,
    weights: FloatArray,
    dimension: int,
) -> FloatArray:
    """The basis, (d, 3n)."""
    # the directions, scaled by the snapshots' extent along them, have the inner products of the
    # snapshots
    rows = subspace.basis.T.reshape(subspace.dimension, -1, 3)
    extents = np.sqrt(energies[: len(rows), None, None])

    def taken_apart(vertices: slice) -> FloatArray:
        """Rows and parts of rows at some vertices, (k, vertices, 3)."""
        whole = extents * rows[:, vertices]
        apart = whole[:TAKEN_APART] * windows[:, None, vertices, None]
        return np.concatenate([whole, *apart])

    some = slice(None, None, -(-len(weights) // VERTICES))
    seen = taken_apart(some) * np.sqrt(weights[some, None])
    shares = _shares(seen.reshape(len(seen), -1), dimension)
    basis = np.empty((len(shares), subspace.tau.size))

    def combine(first: int) -> None:
        parts = taken_apart(slice(first, first + BLOCK // 3))
        basis[:, 3 * first : 3 * first + BLOCK] = shares @ parts.reshape(len(parts), -1)

    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        list(pool.map(combine, range(0, len(weights), BLOCK // 3)))
    orthonormalise(basis, subspace.mass)
    return basis


def _shares(rows: FloatArray, dimension: int) -> FloatArray:
    """Shares (d, k) of rows in their leading principal components, which have length one."""
    eigenvalues, vectors = descending(rows @ rows.T)
    # below the rounding of the largest, directions are noise: windows with sum one are dependent
    rank = int((eigenvalues > len(rows) * np.finfo(float).eps * eigenvalues[0]).sum())
    return scaled(eigenvalues, vectors, min(dimension, rank))


def _checked(windows: ArrayLike, vertices: int) -> FloatArray:
    """Windows as an array (r, n); ValueError for another shape or numbers that are not finite."""
    array = as_numbers("widen", "windows", windows)
    if array.ndim != 2 or array.shape[1] != vertices or not len(array):
        raise ValueError(
            f"widen: windows have shape {array.shape}, but must be (r, {vertices}): one row per "
            "window, one weight per vertex, as handle_windows(problem) has them"
        )
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if bad.size:
        raise ValueError(f"widen: window {bad[0]} has a weight that is not finite")
    return array
