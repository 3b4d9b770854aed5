"""Few columns with positive weights that sum up to a target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve, solve

from ..blas import single_threaded_blas

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

#: Share of the wanted columns that joins before the weights are found anew.
BATCH = 0.1
#: Share that may be missing at the end: the last columns would take as many rounds as all others.
MISSING = 0.02
#: Added to the diagonal of the scaled normal equations: columns that are nearly the same share.
RIDGE = 1e-9


@single_threaded_blas
def nonnegative_fit(
    columns: NDArray[np.float32],
    target: FloatArray,
    count: int,
    *,
    batch: float = BATCH,
    missing: float = MISSING,
) -> tuple[IndexArray, FloatArray]:
    """Least squares with at most `count` positive weights.

    Greedy cubature (An, Kim, James 2008) as orthogonal matching pursuit with positive weights
    (Bruckstein, Elad, Zibulevsky 2008): the columns with the largest products with the residual
    join, a batch at a time, and the weights of all are found anew by non-negative least squares
    (Lawson & Hanson 1974), which lets columns go again.
    Products are not divided by the columns' norms, so that tets that hardly carry a force cannot
    get huge weights.

    Parameters
    ----------
    columns : (k, c) float32
    target : (k,)
    count : int, >= 1
    batch : share of the count that joins before the weights are found anew
    missing : share that may be missing at the end

    Returns
    -------
    chosen : (r,) ascending indices, r <= count
    weights : (r,) > 0
    """
    chosen: IndexArray = np.zeros(0, np.intp)
    weights: FloatArray = np.zeros(0)
    own: FloatArray = np.zeros((len(target), 0))
    gram: FloatArray = np.zeros((0, 0))
    residual = target
    several = max(1, round(batch * count))
    best = np.inf
    while count - len(chosen) > missing * count:
        products = residual.astype(np.float32) @ columns
        products[chosen] = 0.0
        fresh = _largest(products, min(several, count - len(chosen)))
        chosen = np.concatenate([chosen, fresh])
        new = columns[:, fresh].astype(np.float64)
        mixed = own.T @ new
        gram = np.block([[gram, mixed], [mixed.T, new.T @ new]])
        own = np.hstack([own, new])
        start = np.concatenate([weights, np.zeros(len(fresh))])
        weights = nonnegative_weights(gram, own.T @ target, start)
        kept = weights > 0
        chosen, weights = chosen[kept], weights[kept]
        own, gram = own[:, kept], gram[np.ix_(kept, kept)]
        residual = target - own @ weights
        error = float(np.linalg.norm(residual))
        if len(fresh) == 0 or not error < best * (1 - 1e-6):
            break
        best = error
    order = np.argsort(chosen)
    return chosen[order], weights[order]


def nonnegative_weights(gram: FloatArray, moments: FloatArray, start: FloatArray) -> FloatArray:
    """Minimum of x.Gx / 2 - m.x over x >= 0 among the columns, from a start >= 0.

    The inner loop of Lawson & Hanson 1974, ch. 23: columns that would become negative leave at the
    boundary, and do not come back. New columns start at zero.

    The matrix is factored once. With the columns R gone the minimum is that of all less
    A_R (A_RR)^-1 x_R, where A is the inverse: a column that leaves takes one solve.
    """
    scale = 1.0 / np.sqrt(np.diag(gram))
    matrix = gram * scale[:, None] * scale + RIDGE * np.eye(len(gram))
    moments, x = moments * scale, start / scale
    factor = cho_factor(matrix, check_finite=False)
    unbound = cho_solve(factor, moments, check_finite=False)
    solution, inside = unbound, np.ones(len(gram), bool)
    gone: IndexArray = np.zeros(0, np.intp)
    inverse: FloatArray = np.zeros((len(gram), 0))
    while inside.any():
        negative = inside & (solution <= 0)
        if not negative.any():
            return _settled(matrix, moments, solution, inside) * scale
        at_zero = negative & (x <= 0)
        if not at_zero.any():
            step = np.min(x[negative] / (x[negative] - solution[negative]))
            x += step * (np.where(inside, solution, 0.0) - x)
            at_zero = negative & (x <= 1e-12 * x.max())
            x[at_zero] = 0.0
        leaving = np.flatnonzero(at_zero)
        inside[leaving] = False
        units = np.zeros((len(gram), len(leaving)))
        units[leaving, np.arange(len(leaving))] = 1.0
        inverse = np.hstack([inverse, cho_solve(factor, units, check_finite=False)])
        gone = np.concatenate([gone, leaving])
        solution = unbound - inverse @ solve(inverse[gone], unbound[gone], assume_a="pos")
    return np.zeros(len(gram))


def _settled(
    matrix: FloatArray, moments: FloatArray, solution: FloatArray, inside: NDArray[np.bool_]
) -> FloatArray:
    """The minimum among the columns inside, free of the rounding of those that have left."""
    free = np.flatnonzero(inside)
    factor = cho_factor(matrix[np.ix_(free, free)], overwrite_a=True, check_finite=False)
    settled = np.zeros(len(matrix))
    settled[free] = cho_solve(factor, moments[free], check_finite=False)
    return settled if (settled[free] > 0).all() else np.where(inside, solution, 0.0)


def _largest(products: NDArray[np.float32], count: int) -> IndexArray:
    """Indices of the largest positive entries, at most `count`, ascending."""
    largest = np.argpartition(-products, count - 1)[:count]
    return np.sort(largest[products[largest] > 0])
