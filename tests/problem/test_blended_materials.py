"""Blends of every registered material: the energies that `InterpolationProblem` sums."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    MATERIALS,
    InterpolationProblem,
    Poses,
    StableNeoHookean,
    sample,
    solve_snapshots,
)
from snapspace.generators import lizard_poses
from snapspace.mesh import mass_norm

from ..shapes import bar_poses, deformed, moved, random_rotation
from ..taylor import observed_order
from .test_interpolation_problem import written_out

FloatArray = NDArray[np.float64]
POSES = bar_poses()
MESH = POSES.reference
TETS = len(POSES.tets)
WEIGHTS = np.array([0.5, 0.2, 0.3])
every_kind = pytest.mark.parametrize("kind", sorted(MATERIALS))


def problem(kind: str) -> InterpolationProblem:
    """Three poses of a bar that is stiff at one end."""
    along = np.linspace(0.0, 1.0, TETS)
    material = MATERIALS[kind].from_lame(lam=1.0 + 2.0 * along, mu=0.5 * 10.0**along)
    return InterpolationProblem(POSES, material=material)


@every_kind
@pytest.mark.parametrize("size", [0.0, 1e-3, 0.1, 1.0])
@pytest.mark.parametrize(
    "weights", [WEIGHTS, np.array([1.4, -0.3, -0.1]), np.eye(3)[0], np.eye(3)[2]]
)
def test_the_blend_is_the_weighted_sum_of_the_poses_energies(
    kind: str, size: float, weights: FloatArray
) -> None:
    """It is so even where the density collapses to a few numbers per tet, in double precision."""
    one = problem(kind)
    x = deformed(MESH, size)
    if one.material.barrier and size == 1.0:
        x = deformed(MESH, 0.05)
    value, gradient = one.value_and_gradient(x, weights)
    expected, expected_gradient, scale = written_out(x, weights, one)
    assert value == pytest.approx(expected, abs=1e-12 * (scale + 1e-2))
    assert np.abs(gradient - expected_gradient).max() <= 1e-11 * (scale + 1e-2)


@every_kind
def test_stresses_of_tets_make_the_gradient(kind: str) -> None:
    """The energies sum to the value, and stresses do the work of the gradient along a motion."""
    one = problem(kind)
    u = deformed(MESH, 0.05) - one.base
    value, gradient = one.system.value_and_gradient(u, WEIGHTS)
    every = np.arange(len(MESH.tets), dtype=np.int32)
    stresses, energies = one.system.some_tet_stresses(u, WEIGHTS, every)
    assert energies.sum() == pytest.approx(value, rel=1e-12)
    along = np.random.default_rng(1).normal(size=u.size)
    edges = MESH.vertices[MESH.tets[:, 1:]] - MESH.vertices[MESH.tets[:, :1]]
    moves = along.reshape(-1, 3)[MESH.tets]
    change = np.linalg.inv(edges) @ (moves[:, 1:] - moves[:, :1])  # transposed
    work = np.einsum("tab,tba->", stresses.reshape(-1, 3, 3), change)
    assert work == pytest.approx(gradient @ along, rel=1e-10)


@every_kind
def test_stresses_of_some_tets_are_those_of_all(kind: str) -> None:
    """This holds in any order, and for so many poses that their numbers are summed before."""
    one, four_times = problem(kind), Poses(np.tile(POSES.shapes, (4, 1, 1)), POSES.tets)
    many = InterpolationProblem(four_times, material=one.material).system
    u = deformed(MESH, 0.05) - one.base
    stresses, energies = one.system.some_tet_stresses(u, WEIGHTS, np.arange(TETS, dtype=np.int32))
    which = np.random.default_rng(2).permutation(TETS)[: TETS // 2].astype(np.int32)
    for system, weights in ((one.system, WEIGHTS), (many, np.tile(WEIGHTS, 4) / 4.0)):
        some, parts = system.some_tet_stresses(u, weights, which)
        assert some == pytest.approx(stresses[which], abs=1e-12 * np.abs(stresses).max())
        assert parts == pytest.approx(energies[which], abs=1e-12 * energies.max())


@pytest.mark.parametrize("which", [[TETS], [-1], [3, 3]])
def test_stresses_of_a_tet_that_is_not_there_or_twice(which: list[int]) -> None:
    one = problem("stable-neo-hookean")
    with pytest.raises(ValueError, match=r"a tet is not in the mesh|a tet occurs twice"):
        one.system.some_tet_stresses(0.0 * one.base, WEIGHTS, np.array(which, np.int32))


@every_kind
def test_taylor(kind: str) -> None:
    one = problem(kind)
    x = deformed(MESH, 0.05)
    direction = np.random.default_rng(3).normal(size=x.size)
    direction /= np.abs(direction).max() * 20.0
    value, gradient = one.value_and_gradient(x, WEIGHTS)

    def remainder(h: float) -> float:
        return (
            one.value_and_gradient(x + h * direction, WEIGHTS)[0]
            - value
            - h * (gradient @ direction)
        )

    assert observed_order(remainder) == pytest.approx(2, abs=0.15)


@every_kind
def test_frames_of_shape_and_poses_do_not_matter(kind: str) -> None:
    one = problem(kind)
    x, R = deformed(MESH, 0.05), random_rotation(5)
    value, gradient = one.value_and_gradient(x, WEIGHTS)
    there, turned = one.value_and_gradient(moved(x, R, np.array([1.0, 2.0, -1.0])), WEIGHTS)
    assert there == pytest.approx(value, rel=1e-11)
    assert turned == pytest.approx(moved(gradient, R), abs=1e-10 * np.abs(gradient).max())


@pytest.mark.parametrize("kind", sorted(set(MATERIALS) - {"symmetric-dirichlet"}))
def test_one_hot_weights_give_the_pose(kind: str) -> None:
    """Nearly one-hot weights have no known solution and are solved from the mean shape."""
    one = problem(kind)
    for k, pose in enumerate(one.pose_shapes):
        batch = one.system.value_and_gradient(pose - one.base, np.eye(3)[k])
        assert batch[0] == pytest.approx(0.0, abs=1e-12)
    near = 0.999 * np.eye(3) + 0.001 / 3.0
    solved = solve_snapshots(one, near, threads=1)
    assert solved.converged.all()
    size = mass_norm(one.mass(), one.pose_shapes[1] - one.tau)
    for k, pose in enumerate(one.pose_shapes):
        shape = one.base + solved.displacements[k]
        assert mass_norm(one.mass(), shape - pose) < 0.02 * size


def test_the_order_of_the_poses_does_not_matter() -> None:
    """The shapes agree up to the frame, which is that of the first pose."""
    poses = lizard_poses(3, 600, seed=4)
    material = StableNeoHookean(lam=2.0, mu=0.8)
    forward = InterpolationProblem(poses, material=material)
    backward = InterpolationProblem(poses[::-1], material=material)
    weights = sample(forward.domain, 4, seed=2)
    one = solve_snapshots(forward, weights, threads=1)
    other = solve_snapshots(backward, weights[:, ::-1], threads=1)
    for k in range(4):
        shape = forward.base + one.displacements[k]
        same = forward.aligned(backward.base + other.displacements[k], shape)
        size = mass_norm(forward.mass(), shape - forward.tau)
        assert mass_norm(forward.mass(), same - shape) < 1e-3 * size
