"""Radial basis functions: Gaussians around points of the mesh (paper, sec. 7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import snapspace as ss

from .farthest_points import farthest_points

FloatArray = NDArray[np.float64]

#: Width of the Gaussians over the distance of a point to its nearest one.
WIDTH = 1.0


def radial_basis_subspace(problem: ss.PosingProblem, dimension: int) -> ss.AffineSubspace:
    """x, y and z of one normalised Gaussian for each third of the dimension, on farthest points.

    The paper says only that Gaussians are isotropic and use distances in the embedding space. Here
    they add up to one in each vertex, so that translations are in the subspace.
    """
    vertices = problem.mesh.vertices
    points = farthest_points(vertices, dimension // 3)
    return ss.affine_subspace(
        np.kron(gaussians(vertices, points), np.eye(3)), problem, nested=False
    )


def gaussians(vertices: FloatArray, points: NDArray[np.int64]) -> FloatArray:
    """Weights (n, k) of Gaussians that add up to one in each vertex."""
    centers = vertices[points]
    between = np.linalg.norm(centers[:, None] - centers[None], axis=2)
    np.fill_diagonal(between, np.inf)
    width = WIDTH * float(between.min(axis=1).max()) if len(points) > 1 else 1.0
    squares = np.array([((vertices - center) ** 2).sum(axis=1) for center in centers]).T
    weights = np.exp((squares.min(axis=1)[:, None] - squares) / (2.0 * width**2))
    normalised: FloatArray = weights / weights.sum(axis=1, keepdims=True)
    return normalised
