"""A few columns with positive weights whose sum fits a target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.linalg.lapack import dposv

from ..blas import single_threaded_blas
from .chosen_columns import ChosenColumns

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

#: Share of the wanted columns that are added before the weights are recomputed.
BATCH = 0.2
#: Share of the wanted columns that may be missing at the end: the last ones would take as many
#: rounds as all others.
MISSING = 0.02
#: Added to the diagonal of the scaled normal equations, so that nearly equal columns share a
#: weight.
RIDGE = 1e-9


@single_threaded_blas
def nonnegative_fit(
    columns: NDArray[np.float32],
    target: FloatArray,
    count: int,
    *,
    seed: int = 0,
    threads: int | None = None,
) -> tuple[IndexArray, FloatArray]:
    """Least squares with at most `count` positive weights.

    Greedy cubature (An, Kim, James 2008) as orthogonal matching pursuit with positive weights
    (Bruckstein, Elad, Zibulevsky 2008): each step adds a batch of columns, drawn at random in
    proportion to their positive products with the residual. Then all weights are recomputed by
    non-negative least squares (Lawson & Hanson 1974), which may remove columns again.
    Batches are random because the columns with the largest products are very similar, and one of
    them makes most others superfluous: two thirds or more of a batch of these would be removed at
    once, and fits would take up to three times as long. Products are not divided by the columns'
    norms, so that tets that hardly carry a force cannot get huge weights.

    Parameters
    ----------
    columns : (c, k) float32
        The candidate columns, each contiguous.
    target : (k,)
        The vector to fit.
    count : int, >= 1
        Largest number of columns to choose.
    seed : int, default 0
        Seed of the random batches.
    threads : int, optional
        Default: all. The result is bitwise the same for any number.

    Returns
    -------
    chosen : (r,)
        Ascending indices, r <= count.
    weights : (r,)
        Their weights, > 0.
    """
    fit = ChosenColumns(columns, target, count, threads=threads)
    chosen: IndexArray = np.zeros(0, np.intp)
    weights: FloatArray = np.zeros(0)
    residual = target
    batch = max(1, round(BATCH * count))
    best, rng = np.inf, np.random.default_rng(seed)
    while count - len(chosen) > MISSING * count:
        products = fit.candidate_products(residual)
        products[chosen] = 0.0
        fresh = drawn(products, min(batch, count - len(chosen)), rng)
        chosen = np.concatenate([chosen, fresh])
        fit.add(fresh)
        start = np.concatenate([weights, np.zeros(len(fresh))])
        weights = nonnegative_weights(fit.gram, fit.moments, start, settled=False)
        kept = weights > 0
        chosen, weights = chosen[kept], weights[kept]
        fit.keep(kept)
        residual = fit.residual(weights)
        error = float(np.linalg.norm(residual))
        if len(fresh) == 0 or not error < best * (1 - 1e-6):
            break
        best = error
    if len(chosen):
        weights = nonnegative_weights(fit.gram, fit.moments, weights)
        chosen, weights = chosen[weights > 0], weights[weights > 0]
    order = np.argsort(chosen)
    return chosen[order], weights[order]


def nonnegative_weights(
    gram: FloatArray, moments: FloatArray, start: FloatArray, *, settled: bool = True
) -> FloatArray:
    """Minimum of x.Gx / 2 - m.x over x >= 0 among the columns, from a start >= 0.

    The inner loop of Lawson & Hanson 1974, ch. 23: columns that would become negative leave at the
    boundary, and do not come back. New columns start at zero. With `settled`, the weights are
    solved for once more at the end, without the rounding errors of the removed columns.

    The matrix is factored once. Without the columns R, the minimum is that of all columns minus
    A_R (A_RR)^-1 x_R, where A is the inverse matrix, so each column that leaves takes one solve.
    Columns whose weights would become negative are likely to leave next, so their columns of the
    inverse are solved for together.
    """
    scale = 1.0 / np.sqrt(np.diag(gram))
    matrix = gram * scale[:, None]
    matrix *= scale
    matrix.flat[:: len(gram) + 1] += RIDGE
    moments, x = moments * scale, start / scale
    factor = cho_factor(matrix, check_finite=False)
    unbound = cho_solve(factor, moments, check_finite=False)
    solution, inside = unbound, np.ones(len(gram), bool)
    gone: IndexArray = np.zeros(0, np.intp)
    inverse = np.empty((len(gram), len(gram)), order="F")  # columns that were solved for
    known = np.zeros(len(gram), bool)
    while inside.any():
        negative = inside & (solution <= 0)
        if not negative.any():
            inner = np.where(inside, solution, 0.0)
            return (_settled(matrix, moments, inner) if settled else inner) * scale
        at_zero = negative & (x <= 0)
        if not at_zero.any():
            step = np.min(x[negative] / (x[negative] - solution[negative]))
            x += step * (np.where(inside, solution, 0.0) - x)
            at_zero = negative & (x <= 1e-12 * x.max())
            x[at_zero] = 0.0
        leaving = np.flatnonzero(at_zero)
        inside[leaving] = False
        if not known[leaving].all():
            wanted = np.flatnonzero(negative & ~known)
            units = np.zeros((len(gram), len(wanted)), order="F")
            units[wanted, np.arange(len(wanted))] = 1.0
            inverse[:, wanted] = cho_solve(factor, units, overwrite_b=True, check_finite=False)
            known[wanted] = True
        gone = np.concatenate([gone, leaving])
        shares = dposv(inverse[np.ix_(gone, gone)], unbound[gone])[1]
        solution = unbound - inverse[:, gone] @ shares
    return np.zeros(len(gram))


def _settled(matrix: FloatArray, moments: FloatArray, solution: FloatArray) -> FloatArray:
    """The minimum for the columns in a solution, without rounding errors of removed columns."""
    free = np.flatnonzero(solution)
    factor = cho_factor(matrix[np.ix_(free, free)], overwrite_a=True, check_finite=False)
    settled = np.zeros(len(matrix))
    settled[free] = cho_solve(factor, moments[free], check_finite=False)
    return settled if (settled[free] > 0).all() else solution


def drawn(products: NDArray[np.float32], count: int, rng: np.random.Generator) -> IndexArray:
    """Indices of at most `count` positive entries, drawn in proportion to these, ascending.

    Each entry is the rate of an event; its waiting time is exponential, and the earliest events
    are a weighted sample without repetition (Efraimidis & Spirakis 2006).
    """
    positive = np.flatnonzero(products > 0)
    # One time for each entry, positive or not: if rounding changes a sign, the other times stay.
    times = rng.exponential(size=len(products))[positive] / products[positive]
    first = np.argsort(times, kind="stable")[:count]
    return np.sort(positive[first])
