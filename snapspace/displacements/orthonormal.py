"""Making directions orthonormal in the M-norm, in place."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky, solve_triangular
from scipy.sparse import csr_array

from .displacement_rows import BLOCK
from .snapshot_gram import SnapshotGram

FloatArray = NDArray[np.float64]


def orthonormalise(directions: FloatArray, mass: csr_array) -> None:
    """Restores U^T M U = I for nearly orthonormal rows (d, 3n), the columns of U, and fixes signs.

    Makes at most two passes of Cholesky QR. Their factors are triangular, so bases stay nested.
    They are needed because the Gram matrix squares the condition number: a direction with
    eigenvalue lambda_i is orthonormal only to eps * lambda_1 / lambda_i, far from 1e-12 for the
    last of forty. The entry of a direction that is largest in absolute value becomes positive.

    Raises
    ------
    ValueError
        If the last directions are noise.
    """
    gram = _gram(directions, mass)
    for _ in range(2):
        if _error(gram) <= 1e-13:
            break
        _divide(directions, cholesky(gram))
        gram = _gram(directions, mass)
    if _error(gram) > 1e-10:
        raise ValueError(
            f"pca: the basis is orthonormal only to {_error(gram):.1e}; the last directions are "
            "noise; choose a smaller dimension"
        )
    for direction in directions:
        direction *= np.sign(direction[np.abs(direction).argmax()])


def _divide(directions: FloatArray, factor: FloatArray) -> None:
    """Replaces the directions U by U R^-1, with an upper triangular factor R, in fixed blocks."""

    def divide(start: int) -> None:
        block = directions[:, start : start + BLOCK]
        block[:] = solve_triangular(factor, block, trans="T", check_finite=False)

    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        list(pool.map(divide, range(0, directions.shape[1], BLOCK)))


def _error(gram: FloatArray) -> float:
    return float(np.abs(gram - np.eye(len(gram))).max())


def _gram(directions: FloatArray, mass: csr_array) -> FloatArray:
    gram = SnapshotGram(mass)
    gram.add(list(directions))
    return gram.matrix
