from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import ElasticEnergy, InterpolationProblem, Poses, TetMesh
from snapspace.mesh import mass_norm, tet_volumes
from snapspace.registration import registered, rigid_registration

from ..shapes import (
    deformed,
    interpolation_problem,
    moved,
    random_rotation,
)
from ..taylor import observed_order

FloatArray = NDArray[np.float64]
PROBLEM = interpolation_problem()
POSES = PROBLEM.poses
MESH = PROBLEM.mesh
WEIGHTS = np.array([0.5, 0.2, 0.3])
SHIFT = np.array([3.0, -1.0, 2.0])


def written_out(
    x: FloatArray, w: FloatArray, problem: InterpolationProblem = PROBLEM
) -> tuple[float, FloatArray, float]:
    """sum_k w_k E_k with pose k as the mesh of E_k, its gradient, and the sum of |w_k| E_k."""
    value, size, gradient = 0.0, 0.0, np.zeros(x.size)
    for weight, pose in zip(w, problem.poses.shapes, strict=True):
        energy = ElasticEnergy(TetMesh(pose, problem.poses.tets), problem.material)
        one, by_x = energy.value_and_gradient(x)
        gradient += weight * by_x
        value, size = value + weight * one, size + abs(weight) * one
    return value, gradient, size


@given(
    weights=st.tuples(*[st.floats(-3, 3)] * 3),
    size=st.floats(0, 2),
    seed=st.integers(0, 2**32 - 1),
)
@settings(max_examples=40)
def test_the_objective_is_the_weighted_sum_of_the_poses_energies(
    weights: tuple[float, ...], size: float, seed: int
) -> None:
    x, w = deformed(MESH, size, seed=seed), np.array(weights)
    value, gradient = PROBLEM.value_and_gradient(x, w)
    expected, expected_gradient, scale = written_out(x, w)
    assert value == pytest.approx(expected, abs=1e-12 * scale + 1e-14)
    assert np.abs(gradient - expected_gradient).max() <= 1e-11 * (scale + 1e-3)


@pytest.mark.parametrize("weights", [WEIGHTS, np.array([1.4, -0.3, -0.1]), np.ones(3)])
@pytest.mark.parametrize("size", [0.2, 1.0])
def test_taylor_of_the_objective(size: float, weights: FloatArray) -> None:
    x = deformed(MESH, size)
    direction = np.random.default_rng(3).normal(size=x.size)
    value, gradient = PROBLEM.value_and_gradient(x, weights)
    assert np.linalg.norm(gradient) > 0

    def remainder(h: float) -> float:
        moved_value, _ = PROBLEM.value_and_gradient(x + h * direction, weights)
        return moved_value - value - h * gradient @ direction

    assert observed_order(remainder) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("seed", range(3))
def test_a_rigid_motion_of_the_shape_keeps_the_objective(seed: int) -> None:
    x, R = deformed(MESH, 0.3), random_rotation(seed)
    value, gradient = PROBLEM.value_and_gradient(x, WEIGHTS)
    there, turned = PROBLEM.value_and_gradient(moved(x, R, SHIFT), WEIGHTS)
    assert there == pytest.approx(value, rel=1e-11)
    assert turned == pytest.approx(moved(gradient, R), abs=1e-11 * np.abs(gradient).max())


@pytest.mark.parametrize("pose", range(3))
def test_a_rigid_motion_of_a_pose_keeps_the_objective(pose: int) -> None:
    """Each pose has its own frame; only the mean shape follows that of the first."""
    shapes = POSES.shapes.copy()
    R = random_rotation(7)
    shapes[pose] = shapes[pose] @ R.T + SHIFT
    other = InterpolationProblem(Poses(shapes, POSES.tets), material=PROBLEM.material)
    x = deformed(MESH, 0.3)
    value, gradient = PROBLEM.value_and_gradient(x, WEIGHTS)
    same, same_gradient = other.value_and_gradient(x, WEIGHTS)
    assert same == pytest.approx(value, rel=1e-11)
    assert same_gradient == pytest.approx(gradient, abs=1e-10 * np.abs(gradient).max())
    mean = PROBLEM.tau if pose else moved(PROBLEM.tau, R, SHIFT)
    assert other.tau == pytest.approx(mean, abs=1e-5)


@pytest.mark.parametrize("weights", [WEIGHTS, np.array([1.4, -0.3, -0.1])])
def test_the_forces_neither_push_nor_turn_the_body(weights: FloatArray) -> None:
    """This is why solvers do not drift along the six rigid directions."""
    x = deformed(MESH, 0.5)
    forces = PROBLEM.value_and_gradient(x, weights)[1].reshape(-1, 3)
    scale = np.abs(forces).sum()
    assert np.abs(forces.sum(axis=0)).max() < 1e-14 * scale
    assert np.abs(np.cross(x.reshape(-1, 3), forces).sum(axis=0)).max() < 1e-13 * scale


def test_the_energy_of_a_pose_vanishes_at_the_pose() -> None:
    """It vanishes up to the rounding of the other poses' energies."""
    for k, pose in enumerate(POSES.shapes):
        others, forces = PROBLEM.value_and_gradient(pose, 1.0 - np.eye(3)[k])
        for shape in (pose.reshape(-1), PROBLEM.pose_shapes[k]):
            value, gradient = PROBLEM.value_and_gradient(shape, np.eye(3)[k])
            assert abs(value) < 1e-14 * others
            assert np.abs(gradient).max() < 1e-12 * np.abs(forces).max()


def test_the_mean_shape_is_the_minimum_for_equal_weights() -> None:
    center = np.full(3, 1 / 3)
    value, gradient = PROBLEM.value_and_gradient(PROBLEM.tau, center)
    tension = [PROBLEM.value_and_gradient(PROBLEM.tau, e)[1] for e in np.eye(3)]
    assert np.linalg.norm(gradient) < 1e-4 * min(np.linalg.norm(force) for force in tension)
    for shape in (*PROBLEM.pose_shapes, PROBLEM.linear_blend(center)):
        assert value < 0.9 * PROBLEM.value_and_gradient(shape, center)[0]
    rng = np.random.default_rng(0)
    for _ in range(20):
        nearby = PROBLEM.tau + rng.normal(0, 1e-3, PROBLEM.tau.size)
        assert PROBLEM.value_and_gradient(nearby, center)[0] > value


def test_the_mean_shape_does_not_depend_on_the_order_of_the_poses() -> None:
    for order in ([1, 0, 2], [2, 1, 0], [1, 2, 0]):
        # pose 2 twists the bar, yet none of its tets is inverted: any pose can be the first
        permuted = Poses(POSES.shapes[order], POSES.tets)
        other = InterpolationProblem(permuted, material=PROBLEM.material)
        same = registered(other.tau, PROBLEM.tau, PROBLEM.mass())
        size = mass_norm(PROBLEM.mass(), PROBLEM.tau - PROBLEM.pose_shapes[1])
        assert mass_norm(PROBLEM.mass(), same - PROBLEM.tau) < 1e-5 * size


def test_the_mean_shape_lies_in_the_frame_of_the_first_pose() -> None:
    mean_mesh = TetMesh(PROBLEM.tau.reshape(-1, 3), POSES.tets)
    assert np.abs(PROBLEM.mass() - PROBLEM.mass(lumped=False)).max() == 0.0
    assert PROBLEM.mass().sum() == pytest.approx(mean_mesh.volume)
    assert np.diff(PROBLEM.mass(lumped=True).indptr).max() == 1, "diagonal"
    motion = rigid_registration(PROBLEM.tau, PROBLEM.base, PROBLEM.mass())
    assert motion.rotation == pytest.approx(np.eye(3), abs=1e-12)
    assert motion.translation == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_known_mean_shape_is_taken_as_it_is() -> None:
    known = InterpolationProblem(POSES, material=PROBLEM.material, mean_shape=PROBLEM.tau)
    assert np.array_equal(known.tau, PROBLEM.tau)
    assert np.array_equal(known.pose_shapes, PROBLEM.pose_shapes)


def edges(shape: FloatArray) -> FloatArray:
    corners = shape.reshape(-1, 3)[POSES.tets]
    lengths: FloatArray = np.linalg.norm(
        corners[:, [0, 0, 0, 1, 1, 2]] - corners[:, [1, 2, 3, 2, 3, 3]], axis=2
    )
    return lengths


def test_pose_shapes_are_the_poses_turned_towards_the_mean_shape() -> None:
    assert PROBLEM.pose_shapes.shape == (3, MESH.vertices.size)
    for pose, shape in zip(POSES.shapes, PROBLEM.pose_shapes, strict=True):
        assert edges(shape) == pytest.approx(edges(pose), rel=1e-12)
        volumes = tet_volumes(shape.reshape(-1, 3), POSES.tets)
        assert volumes == pytest.approx(tet_volumes(pose, POSES.tets), rel=1e-9), "not mirrored"
        motion = rigid_registration(shape, PROBLEM.tau, PROBLEM.mass())
        assert motion.rotation == pytest.approx(np.eye(3), abs=1e-12)


def test_solutions_that_are_known_are_the_mean_shape_and_the_poses() -> None:
    weights, shapes = PROBLEM.known_solutions()
    assert np.array_equal(weights, np.vstack([np.full(3, 1 / 3), np.eye(3)]))
    assert np.array_equal(shapes, np.vstack([PROBLEM.tau, PROBLEM.pose_shapes]))


def test_registered_displacements_are_those_of_the_registered_shapes() -> None:
    shapes = [moved(deformed(MESH, 0.2, seed=k), random_rotation(k), SHIFT) for k in range(3)]
    found = PROBLEM.registered(np.array(shapes) - PROBLEM.base) + PROBLEM.base
    for shape, one in zip(shapes, found, strict=True):
        assert one == pytest.approx(PROBLEM.aligned(shape, PROBLEM.tau), abs=1e-12)


def test_the_linear_blend_is_the_straight_path_between_the_registered_poses() -> None:
    for one_hot, shape in zip(np.eye(3), PROBLEM.pose_shapes, strict=True):
        assert np.array_equal(PROBLEM.linear_blend(one_hot).reshape(-1), shape)
    blend = PROBLEM.linear_blend(WEIGHTS).reshape(-1)
    assert blend == pytest.approx(WEIGHTS @ PROBLEM.pose_shapes, abs=1e-13)
    beyond = np.array([1.5, -0.25, -0.25])
    with pytest.raises(ValueError, match=r"weight 1 is -0\.25, but none may be below 0"):
        PROBLEM.linear_blend(beyond)
    blend = PROBLEM.linear_blend(beyond, extrapolate=True).reshape(-1)
    assert blend == pytest.approx(beyond @ PROBLEM.pose_shapes, abs=1e-13)


def test_the_energy_of_a_pose_is_that_of_the_objective() -> None:
    x = deformed(MESH, 0.3)
    for k, one_hot in enumerate(np.eye(3)):
        value, gradient = PROBLEM.pose_energy(k).value_and_gradient(x - PROBLEM.pose_shapes[k])
        expected, expected_gradient = PROBLEM.value_and_gradient(x, one_hot)
        assert value == pytest.approx(expected, rel=1e-12)
        assert gradient == pytest.approx(expected_gradient, abs=1e-11)


def test_defaults_are_those_of_the_paper() -> None:
    problem = InterpolationProblem([TetMesh(pose, POSES.tets) for pose in POSES.shapes])
    assert (problem.material.lam, problem.material.mu) == (1.0, 1.0)
    assert problem.parameter_count == 3
    assert (problem.domain.corners, problem.domain.extrapolation) == (3, 0.0)
    assert problem.mesh.fingerprint == MESH.fingerprint
    assert problem.poses.names == ("pose 0", "pose 1", "pose 2")
