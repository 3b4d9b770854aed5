"""Skinning eigenmodes: affine motions blended by eigenfunctions (Benchekroun et al. 2023)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.linalg import LinearOperator, eigsh

import snapspace as ss
from snapspace.mesh import solid_of

from .laplacian import tet_laplacian
from .sparse_solver import SparseSolver

FloatArray = NDArray[np.float64]

#: Degrees of freedom of an affine map.
AFFINE = 12
SHIFT = 1e-6


def skinning_subspace(problem: ss.PosingProblem, dimension: int) -> ss.AffineSubspace:
    """Affine maps, each weighted by one of the smoothest eigenfunctions of the Laplacian.

    The constant is the first, so that all affine motions of the body are in the subspace. The last
    eigenfunction gives only as many columns as are left of the dimension.
    """
    weights = skinning_weights(problem, -(-dimension // AFFINE))
    vertices = problem.mesh.vertices
    arms = np.column_stack([vertices - vertices.mean(axis=0), np.ones(len(vertices))])
    columns = (weights[:, :, None] * arms[:, None, :]).reshape(len(vertices), -1)
    # constants first: a cut leaves whole translations before linear maps
    order = np.arange(columns.shape[1]).reshape(-1, 4)[:, ::-1].ravel()
    directions = np.kron(columns[:, order], np.eye(3))[:, :dimension]
    return ss.affine_subspace(directions, problem, nested=False)


def skinning_weights(problem: ss.PosingProblem, count: int) -> FloatArray:
    """The smoothest eigenfunctions (n, count), M-orthonormal, the constant first."""
    mesh, mass = solid_of(problem.mesh, who="skinning_weights"), csr_array(problem.mass())
    laplacian = tet_laplacian(mesh)
    shift = SHIFT * float(laplacian.diagonal().sum() / mass.sum())
    solver = SparseSolver(csr_array(laplacian + shift * mass), per_vertex=1)
    inverse = LinearOperator(laplacian.shape, matvec=solver.solve, dtype=np.float64)
    start = np.random.default_rng(0).standard_normal(len(mesh.vertices))
    values, weights = eigsh(laplacian, count, mass, sigma=-shift, OPinv=inverse, v0=start)
    ordered: FloatArray = weights[:, np.argsort(values)]
    return ordered
