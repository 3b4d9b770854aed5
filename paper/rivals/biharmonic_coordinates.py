"""Biharmonic coordinates (Wang, Jacobson, Barbic & Kavan 2015) of points and handles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array

import snapspace as ss
from snapspace.mesh import solid_of

from .farthest_points import farthest_points
from .laplacian import normal_derivative, tet_laplacian
from .sparse_solver import SparseSolver

FloatArray = NDArray[np.float64]

#: Degrees of freedom of a handle, which moves affinely.
AFFINE = 12


def biharmonic_subspace(problem: ss.PosingProblem, dimension: int) -> ss.AffineSubspace:
    """Affine motions of the handles and motions of farthest points, spread over the mesh.

    d = 12 h + 3 points, as in the paper: 384 are two handles and 120 points.
    """
    handles = [np.asarray(handle.vertices) for handle in problem.handles]
    count = (dimension - AFFINE * len(handles)) // 3
    points = farthest_points(problem.mesh.vertices, count, given=np.concatenate(handles))
    mesh = solid_of(problem.mesh, who="biharmonic_coordinates")
    weights = biharmonic_coordinates(mesh, points, handles)
    return ss.affine_subspace(np.kron(weights, np.eye(3)), problem, nested=False)


def biharmonic_coordinates(
    mesh: ss.TetMesh, points: NDArray[Any], handles: Sequence[NDArray[Any]]
) -> FloatArray:
    """Weights (n, k + 4 h): the values at all vertices that follow from a unit value at each point,
    or from each affine function of a handle.

    They minimise the squared Laplacian with natural boundary conditions, under which linear
    functions have no energy: what is linear on points and handles is linear everywhere, and the
    weights of points add up to one with those of the handles' constants.
    """
    size = len(mesh.vertices)
    values = np.zeros((size, len(points) + 4 * len(handles)))
    values[points, np.arange(len(points))] = 1.0
    for h, vertices in enumerate(handles):
        corner = len(points) + 4 * h
        values[vertices, corner : corner + 3] = mesh.vertices[vertices]
        values[vertices, corner + 3] = 1.0
    fixed = np.zeros(size, bool)
    fixed[points] = True
    fixed[np.concatenate([points, *handles])] = True
    energy = bilaplacian(mesh)
    inner = energy[~fixed][:, ~fixed]
    solver = SparseSolver(csr_array(inner), per_vertex=1)
    values[~fixed] = -solver.solve(energy[~fixed][:, fixed] @ values[fixed])
    return values


def bilaplacian(mesh: ss.TetMesh) -> csr_array:
    """A = (L - N)^T M^-1 (L - N), (n, n), with the lumped masses M."""
    slope = tet_laplacian(mesh) - normal_derivative(mesh)
    masses = ss.mass_matrix(mesh, lumped=True).diagonal()
    return csr_array(slope.T @ diags_array(1.0 / masses) @ slope)
