"""Paths between poses with thin tails: smooth, and the same in both directions and after a jump."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import BlendingSession, InterpolationModel, InterpolationProblem
from snapspace.generators import lizard_poses

from ..conftest import interpolation_model

FloatArray = NDArray[np.float64]
POSES = 4


@pytest.fixture(scope="module")
def lizards() -> InterpolationModel:
    """Four poses of a lizard in the default material, 16 dimensions from 24 blends."""
    poses = lizard_poses(POSES, 800, seed=3)
    return interpolation_model(InterpolationProblem(poses), 24, 16)


def ends(seed: int) -> tuple[FloatArray, FloatArray]:
    """Two blends, of two or three poses each."""
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(2):
        weights = np.zeros(POSES)
        chosen = rng.permutation(POSES)[: rng.integers(1, 4)]
        weights[chosen] = rng.dirichlet(np.ones(len(chosen)))
        found.append(weights)
    return found[0], found[1]


def shapes_along(session: BlendingSession, first: FloatArray, last: FloatArray) -> FloatArray:
    """Shapes (101, n, 3) along the straight path of the weights."""
    shapes = []
    for share in np.linspace(0.0, 1.0, 101):
        assert session.blend((1.0 - share) * first + share * last).converged
        shapes.append(session.vertices)
    return np.array(shapes)


@pytest.mark.parametrize("seed", range(6))
def test_a_path_does_not_depend_on_its_direction(lizards: InterpolationModel, seed: int) -> None:
    session, diagonal = lizards.session(), lizards.problem.mesh.diagonal
    first, last = ends(seed)
    forth = shapes_along(session, first, last)
    back = shapes_along(session, last, first)
    assert np.linalg.norm(forth - back[::-1], axis=2).max() < 1e-3 * diagonal
    for k in (13, 50, 87):
        session.reset()
        session.blend((1.0 - k / 100) * first + k / 100 * last)
        assert np.linalg.norm(session.vertices - forth[k], axis=1).max() < 1e-3 * diagonal


@pytest.mark.parametrize("seed", range(6))
def test_no_step_is_long(lizards: InterpolationModel, seed: int) -> None:
    """With St.Venant-Kirchhoff, tails snap; see docs/notes/blend-paths.md."""
    forth = shapes_along(lizards.session(), *ends(seed))
    steps = np.linalg.norm(np.diff(forth, axis=0), axis=2).max(axis=1)
    assert steps.max() < 4.0 * np.median(steps)
