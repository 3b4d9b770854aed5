"""affine_subspace: the subspace of any given directions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from ..arguments import as_numbers, is_number, shown
from ..blas import single_threaded_blas
from ..mesh import apply_mass
from ..problem import Problem, require_problem
from .affine_subspace import AffineSubspace

FloatArray = NDArray[np.float64]

#: Rounds of Gram-Schmidt per direction: two give orthogonality to rounding (Giraud, Langou,
#: Rozloznik, van den Eshof 2005, "Rounding error analysis of the classical Gram-Schmidt
#: orthogonalization process").
_ROUNDS = 2
#: Number of directions that are made orthogonal to all earlier ones together, by products of
#: matrices. One at a time, they take twice as long for d = 384, since all earlier ones are read for
#: each.
_BLOCK = 32
#: A direction that loses more than this within its block is made orthogonal to all once more.
_CANCELS = 0.1


@single_threaded_blas
def affine_subspace(
    directions: ArrayLike,
    problem: Problem,
    *,
    nested: bool = True,
    rtol: float = 1e-10,
) -> AffineSubspace:
    """The affine subspace through a problem's tau that is spanned by given displacements.

    Use it for a basis of your own: vibration modes, biharmonic coordinates, handle responses. The
    directions are made M-orthonormal in their order, with the mass matrix M of tau.

    Parameters
    ----------
    directions : array_like, (3n, k)
        One displacement x0 y0 z0 x1 ... per column, of any length.
    problem : Problem
    nested : bool, default True
        If True, the first k columns of the basis span the first k directions for every k, so that a
        model can be used with fewer dimensions; the directions must be independent. If False,
        directions that depend on earlier ones are dropped.
    rtol : float, default 1e-10
        A direction depends on earlier ones if less than this share of its M-norm is left.

    Returns
    -------
    AffineSubspace
        It has k dimensions, or fewer if not nested, and no energies. U^T M U = I up to rounding.

    Raises
    ------
    ValueError
        For directions of a wrong shape, if all are zero, if one is not finite, if one depends on
        earlier ones although `nested` is True, or for an rtol that is not in (0, 1).
    """
    require_problem(problem, "affine_subspace")
    if not (is_number(rtol) and 0 < rtol < 1):
        raise ValueError(f"affine_subspace: rtol is {shown(rtol)}, but it must be between 0 and 1")
    columns = _checked(directions, problem.tau.size)
    mass = problem.mass()
    basis = np.empty((columns.shape[1], problem.tau.size))
    weighted = np.empty_like(basis)  # M times the basis
    d = 0
    for first in range(0, columns.shape[1], _BLOCK):
        block = np.array(columns[:, first : first + _BLOCK].T, order="C")
        left = (_normalised(block, mass) > 0.0).astype(np.float64)
        for _ in range(_ROUNDS):
            block -= (block @ weighted[:d].T) @ basis[:d]
            left *= _normalised(block, mass)
        start = d
        for k, direction in enumerate(block, start=first):
            share = _orthogonalised(direction, basis[start:d], weighted[start:d], mass)
            if share < _CANCELS:  # what is left of the earlier blocks has grown with the rest
                share *= _orthogonalised(direction, basis[:d], weighted[:d], mass)
            if share * left[k - first] > rtol:
                basis[d], weighted[d] = direction, apply_mass(mass, direction)
                d += 1
            elif nested:
                raise ValueError(
                    f"affine_subspace: direction {k} is zero or depends on earlier ones "
                    f"({share * left[k - first]:.1g} of it is left); leave it out, or pass "
                    "nested=False, which drops such directions"
                )
    if d == 0:
        raise ValueError("affine_subspace: all directions are zero; at least one must not be")
    return AffineSubspace(problem.tau, np.ascontiguousarray(basis[:d]).T, mass)


def _orthogonalised(
    direction: FloatArray, basis: FloatArray, weighted: FloatArray, mass: csr_array
) -> float:
    """Makes a direction (3n,) orthogonal to rows of a basis, in place, and of unit length.

    Returns the share of its length that is left.
    """
    left = 1.0
    for _ in range(_ROUNDS):
        direction -= (weighted @ direction) @ basis
        left *= float(_normalised(direction[None], mass)[0])
    return left


def _normalised(rows: FloatArray, mass: csr_array) -> FloatArray:
    """Divides rows (k, 3n) by their M-norms (k,), in place; returns these, zero for zero rows."""
    squares = np.einsum("ki,ki->k", rows, apply_mass(mass, rows))
    norms: FloatArray = np.sqrt(np.maximum(squares, 0.0))
    rows /= np.where(norms > 0.0, norms, 1.0)[:, None]
    return norms


def _checked(directions: ArrayLike, size: int) -> FloatArray:
    """A matrix (3n, k) of finite numbers."""
    columns = as_numbers("affine_subspace", "directions", directions)
    if columns.ndim != 2 or columns.shape[0] != size or columns.shape[1] == 0:
        raise ValueError(
            f"affine_subspace: directions have shape {columns.shape}, but must be ({size}, k) with "
            "k >= 1: one column per direction, three rows per vertex"
        )
    bad = np.flatnonzero(~np.isfinite(columns).all(axis=0))
    if bad.size:
        raise ValueError(f"affine_subspace: direction {bad[0]} is not finite")
    return columns
