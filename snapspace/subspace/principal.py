"""descending, scaled: principal components from inner products (method of snapshots)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

FloatArray = NDArray[np.float64]


def descending(gram: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues, the largest first and none negative, and eigenvectors."""
    eigenvalues, vectors = eigh(gram)
    return np.maximum(eigenvalues[::-1], 0.0), vectors[:, ::-1]


def scaled(eigenvalues: FloatArray, vectors: FloatArray, dimension: int) -> FloatArray:
    """Weights (d, k) of the rows in the first d directions, which have length one."""
    weights: FloatArray = (vectors[:, :dimension] / np.sqrt(eigenvalues[:dimension])).T
    return weights
