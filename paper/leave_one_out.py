"""Errors of samples in the subspaces of other samples, from inner products alone.

The best subspace of any selection of samples, and what it leaves of another sample, follow from the
Gram matrix of all of them (method of snapshots; paper, sec. 5.2): leaving a sample out is leaving
out a row and a column.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

import snapspace as ss

FloatArray = NDArray[np.float64]


def leave_one_out_errors(
    gram: ss.SnapshotGram, training: ArrayLike, dimensions: Sequence[int]
) -> FloatArray:
    """Relative errors |x - P x|_M / |x|_M of each sample in the best subspace of all others.

    Parameters
    ----------
    gram : products of displacements from tau
    training : (k,) indices of two samples or more
    dimensions : (j,) of the subspaces; where the others span less, all that they span

    Returns
    -------
    ndarray, (j, k)
    """
    return errors_of_others(gram, training, training, dimensions)


def errors_of_others(
    gram: ss.SnapshotGram, training: ArrayLike, tested: ArrayLike, dimensions: Sequence[int]
) -> FloatArray:
    """The same for any tested samples (t,), each left out if it is a training sample: (j, t)."""
    known, new = np.asarray(training), np.asarray(tested)
    apart = ~np.isin(new, known)
    errors = np.empty((len(dimensions), len(new)))
    if apart.any():
        errors[:, apart] = _rows(gram, known, new[apart], dimensions)
    for column in np.flatnonzero(~apart):
        others = known[known != new[column]]
        errors[:, column] = _rows(gram, others, new[column : column + 1], dimensions)[:, 0]
    return errors


def _rows(
    gram: ss.SnapshotGram,
    training: NDArray[np.intp],
    tested: NDArray[np.intp],
    dimensions: Sequence[int],
) -> FloatArray:
    errors = gram.held_out_errors(training, tested)
    rows: FloatArray = errors[np.minimum(dimensions, len(errors) - 1)]
    return rows
