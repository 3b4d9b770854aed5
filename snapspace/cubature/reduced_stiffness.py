"""Exact Hessians of reduced energies where the coordinates vanish."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..blas import single_threaded_blas
from ..problem import InterpolationProblem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]


@single_threaded_blas
def reduced_stiffness(hessian: csr_array, subspace: AffineSubspace) -> FloatArray:
    """The exact reduced Hessian of a full one (3n, 3n), symmetric."""
    stiffness = subspace.basis.T @ (hessian @ subspace.basis)
    return _symmetric(stiffness)


def _symmetric(matrix: FloatArray) -> FloatArray:
    symmetric: FloatArray = (matrix + matrix.T) / 2
    return symmetric


@single_threaded_blas
def mean_stiffness(
    problem: InterpolationProblem, subspace: AffineSubspace, *, threads: int | None = None
) -> FloatArray:
    """The exact reduced Hessian at the mean shape, (d, d), by central differences of forces.

    They take 2 d gradients for any number of poses, on so many threads (default: all). Only
    directions are weighed with it: the error, of the square of the step, is of no consequence.
    """
    basis = subspace.basis
    mean, dimension = subspace.tau - problem.base, subspace.dimension
    step = 1e-4 * problem.mesh.diagonal * float(np.sqrt(problem.mesh.volume))
    weights = np.tile(problem.domain.center, (dimension, 1))
    after, before = (
        problem.system.evaluate(mean + h * basis.T, weights, threads=threads or 0)[1]
        for h in (step, -step)
    )
    return _symmetric((after - before) @ basis / (2.0 * step))
