"""Poses with a nearly flat tet: its energy, huge away from the pose, must not swamp the rest.

Poses that were fitted to surfaces have such tets.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationProblem, Poses, TetMesh, solve_snapshots

from ..shapes import bent, irregular_bar

FloatArray = NDArray[np.float64]
HEIGHTS = [
    1e-1,
    1e-2,
    1e-3,
    1e-4,
]  # heights of a corner over the opposite face, as shares of the original


def flattened(height: float) -> InterpolationProblem:
    """A bar and a bent one with one corner pressed towards the opposite face of a tet."""
    mesh = irregular_bar(6, 2, 2)
    pose = bent(mesh, 0.8)
    corner = int(np.argmax(mesh.vertices.sum(axis=1)))
    tet = mesh.tets[(mesh.tets == corner).any(axis=1)][0]
    a, b, c = pose[tet[tet != corner]]
    normal = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a))
    pose[corner] -= (1 - height) * ((pose[corner] - a) @ normal) * normal
    poses = Poses(np.stack([mesh.vertices, pose]), mesh.tets, accept_inverted=True)
    before = TetMesh(bent(mesh, 0.8), mesh.tets).volumes.min()
    assert np.abs(poses.volumes[1]).min() < height * 10 * before
    return InterpolationProblem(poses)


@pytest.mark.parametrize("height", HEIGHTS)
def test_values_and_forces_keep_their_digits(height: float) -> None:
    """The energy of a pose vanishes at the pose, up to the rounding of the other's energy."""
    problem = flattened(height)
    pose = problem.poses.shapes[1].reshape(-1)
    away, forces = problem.value_and_gradient(pose, [1.0, 0.0])
    value, gradient = problem.value_and_gradient(pose, [0.0, 1.0])
    assert abs(value) < 1e-12 * away
    assert np.abs(gradient).max() < 1e-9 * np.abs(forces).max()


@pytest.mark.parametrize("height", HEIGHTS)
def test_solves_converge(height: float) -> None:
    problem = flattened(height)
    weights = np.array([[0.5, 0.5], [0.2, 0.8], [0.05, 0.95], [0.9, 0.1]])
    solved = solve_snapshots(problem, weights, threads=1)
    assert solved.converged.all(), solved.summary()
    for w, shape in zip(weights, solved.shapes, strict=True):
        value, gradient = problem.value_and_gradient(shape, w)
        known = min(problem.value_and_gradient(x, w)[0] for x in problem.pose_shapes)
        assert 0 < value < known
        tension = np.linalg.norm(problem.value_and_gradient(shape, [1.0, 0.0])[1])
        assert np.linalg.norm(gradient) < 1e-2 * tension
