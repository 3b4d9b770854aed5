"""The scalar factor of blends whose energies collapse, which is made of sums over the poses."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigvalsh

from snapspace import Corotational, InterpolationProblem, StableNeoHookean
from snapspace.problem import rotation_matrix

from ..shapes import bar_poses, deformed
from .test_adapted_system import forces, rest_system

FloatArray = NDArray[np.float64]
PROBLEM = InterpolationProblem(bar_poses(), material=StableNeoHookean(lam=1.5, mu=0.7))
SYSTEM = rest_system(PROBLEM)
WEIGHTS = np.array([0.2, 0.5, 0.3])


def displaced(size: float) -> FloatArray:
    """Displacements of a shape; with size 2 most tets are far from rest, and many are inverted."""
    return deformed(PROBLEM.mesh, size) - PROBLEM.base


@pytest.mark.parametrize("size", [0.0, 0.3, 2.0])
@pytest.mark.parametrize("weights", [WEIGHTS, np.array([1.2, -0.1, -0.1])])
def test_they_are_between_the_mean_over_coordinates_and_half_as_much_again(
    size: float, weights: FloatArray
) -> None:
    """The volume term counts half instead of a third, all else as in the Hessian."""
    u = displaced(size)
    hessians = SYSTEM.tet_hessians(u, weights).reshape(-1, 3, 3, 3, 3)
    means = np.trace(hessians, axis1=1, axis2=3) / 3
    for scalar, mean in zip(SYSTEM.scalar_hessians(u, weights), means, strict=True):
        np.testing.assert_allclose(scalar, scalar.T, rtol=0, atol=0)
        ratios = eigvalsh(scalar, mean)
        assert ratios.min() > 1 - 1e-12 and ratios.max() < 1.5
        assert ratios.max() > 1.05


def test_they_do_not_change_with_rotations() -> None:
    x = deformed(PROBLEM.mesh, 0.4)
    turned = x.reshape(-1, 3) @ rotation_matrix([0.3, -0.8, 0.5]).T
    before = SYSTEM.scalar_hessians(x - PROBLEM.base, WEIGHTS)
    after = SYSTEM.scalar_hessians(turned.reshape(-1) - PROBLEM.base, WEIGHTS)
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-13 * np.abs(before).max())


def test_at_rest_in_one_pose_all_directions_are_alike() -> None:
    rest, moduli = np.zeros(len(PROBLEM.base)), 0.7 + (1.5 + 0.7) / 2
    scalar = SYSTEM.scalar_hessians(rest, np.array([1.0, 0.0, 0.0]))
    wanted = moduli * PROBLEM.mesh.volumes[:, None, None] * np.eye(3)
    np.testing.assert_allclose(scalar, wanted, rtol=0, atol=1e-13 * wanted.max())


def test_the_factor_is_that_of_the_mean_over_the_shapes() -> None:
    """The regular vertex changes translations only."""
    shapes = np.stack([displaced(0.3), displaced(2.0)])
    weights = np.stack([WEIGHTS, WEIGHTS[::-1]])
    n, tets = len(PROBLEM.mesh.vertices), PROBLEM.mesh.tets
    edges = PROBLEM.mesh.vertices[tets[:, 1:]] - PROBLEM.mesh.vertices[tets[:, :1]]
    hats = np.linalg.inv(edges).transpose(0, 2, 1)
    hats = np.concatenate([-hats.sum(axis=1, keepdims=True), hats], axis=1)
    scalar = np.mean(
        [SYSTEM.scalar_hessians(u, w) for u, w in zip(shapes, weights, strict=True)], axis=0
    )
    matrix = np.zeros((n, n))
    for corners, block in zip(tets, hats @ scalar @ hats.transpose(0, 2, 1), strict=True):
        matrix[np.ix_(corners, corners)] += block
    f = forces(1)
    solution = SYSTEM.adapted(shapes, weights).precondition(f)
    back = (matrix @ solution.reshape(-1, 3)).reshape(-1)
    np.testing.assert_allclose(back, f, rtol=0, atol=1e-9 * np.abs(f).max())


def test_other_densities_have_none() -> None:
    other = rest_system(InterpolationProblem(bar_poses(), material=Corotational()))
    with pytest.raises(ValueError, match="the density has no scalar Hessians of blends"):
        other.scalar_hessians(np.zeros(len(PROBLEM.base)), WEIGHTS)
