"""ResidualSample: a few vertices that estimate the norm of the whole residual."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh import ShellMesh, tet_volumes
from ..problem import InterpolationProblem, PosingProblem

FloatArray = NDArray[np.float64]

#: Number of sampled vertices. On the Dragon 128 of 32k predict the error as well as all do.
VERTICES = 128
#: Share of the vertices drawn uniformly, so that every vertex may be drawn.
UNIFORM = 0.1


@dataclass(frozen=True, eq=False)
class ResidualSample:
    """Vertices v and weights c_v: sum over v of c_v |g_v|^2 estimates g^T D^-1 g.

    vertices : (s,) int32; a vertex may occur more than once
    weights : (s,) float64, positive, 1 / (s * probability * D_v)

    g is the gradient of the full objective, and D the diagonal of the scalar factor's matrix A. The
    norm of g by D is the local part of its norm by A, and predicts the error as well: on unseen
    samples the rank correlations of both with the error are about the same.
    """

    vertices: NDArray[np.int32]
    weights: FloatArray

    def __post_init__(self) -> None:
        same = self.vertices.ndim == 1 and self.vertices.shape == self.weights.shape
        if not (same and len(self.weights) and (self.weights > 0).all()):
            raise ValueError(
                "ResidualSample: needs one positive weight per vertex; calibrate the model again"
            )


def residual_sample(
    expected: FloatArray, diagonal: FloatArray, *, count: int = VERTICES, seed: int = 0
) -> ResidualSample:
    """Draws vertices with probabilities in proportion to their expected contributions.

    Parameters
    ----------
    expected : (n,)
        Squared residuals of the vertices in typical frames.
    diagonal : (n,)
        Diagonal of the scalar factor's matrix.
    count : int, default 128
        Number of vertices to draw.
    seed : int, default 0
        Seed of the draw.

    Returns
    -------
    ResidualSample
        Its estimate is unbiased for every frame (importance sampling), and has nearly no variance
        for a frame whose residuals are proportional to `expected`.
    """
    shares = expected / diagonal
    total = float(shares.sum())
    even = np.full(len(shares), 1.0 / len(shares))
    probabilities = (1.0 - UNIFORM) * shares / total + UNIFORM * even if total > 0 else even
    drawn = np.random.default_rng(seed).choice(len(shares), size=count, p=probabilities)
    vertices = np.sort(drawn).astype(np.int32)
    return ResidualSample(vertices, 1.0 / (count * probabilities[vertices] * diagonal[vertices]))


def scalar_diagonal(problem: PosingProblem | InterpolationProblem) -> FloatArray:
    """D, (n,): the diagonal of the scalar matrix + 2 weights of pins, at tau.

    For blended shells it is the mean of the diagonals at rest in the poses.
    """
    if isinstance(problem, PosingProblem):
        diagonal: FloatArray = problem.energy.core.scalar_diagonal()
        np.add.at(diagonal, problem.pinned, 2.0 * problem.pin_weights)
        return diagonal
    if isinstance(problem.mesh, ShellMesh):
        poses = range(len(problem.poses))
        diagonals = [problem.pose_energy(k).scalar_diagonal() for k in poses]
        return np.asarray(np.mean(diagonals, axis=0))
    tets = problem.mesh.elements
    corners = problem.tau.reshape(-1, 3)[tets]
    edges = corners[:, 1:] - corners[:, :1]
    volumes = np.abs(tet_volumes(problem.tau.reshape(-1, 3), tets))
    hats = np.linalg.inv(edges)  # columns are the gradients of the hat functions 1, 2, 3
    hats = np.concatenate([-hats.sum(axis=2, keepdims=True), hats], axis=2)
    parts = (problem.material.stiffness * volumes)[:, None] * (hats**2).sum(axis=1)
    sums: FloatArray = np.zeros(len(problem.tau) // 3)
    np.add.at(sums, tets, parts)
    return sums
