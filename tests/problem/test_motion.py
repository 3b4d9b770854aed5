from __future__ import annotations

import numpy as np
import pytest

from snapspace.problem import affine_offset, rigid_offset, rotation_matrix

from ..shapes import random_rotation


def about_x(a: float) -> np.ndarray:
    return np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])


def about_y(b: float) -> np.ndarray:
    return np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])


def about_z(c: float) -> np.ndarray:
    return np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])


def test_euler_angles_are_extrinsic_x_then_y_then_z() -> None:
    a, b, c = 0.4, -0.7, 1.9
    expected = about_z(c) @ about_y(b) @ about_x(a)
    assert rotation_matrix([a, b, c]) == pytest.approx(expected, abs=1e-15)
    assert np.abs(expected - about_x(a) @ about_y(b) @ about_z(c)).max() > 0.1


def test_a_quarter_turn_about_z_takes_x_to_y() -> None:
    quarter = rotation_matrix([0, 0, np.pi / 2])
    assert quarter @ [1, 0, 0] == pytest.approx([0, 1, 0], abs=1e-15)


def test_many_angles_at_once() -> None:
    angles = np.random.default_rng(0).uniform(-3, 3, (5, 2, 3))
    matrices = rotation_matrix(angles)
    assert matrices.shape == (5, 2, 3, 3)
    assert np.array_equal(matrices[3, 1], rotation_matrix(angles[3, 1]))


def test_the_identity_has_offset_zero() -> None:
    assert not rigid_offset([0, 0, 0], [0, 0, 0]).any()
    assert not affine_offset(np.eye(3, 4), [3.0, -1.0, 2.0]).any()


def test_a_rigid_offset_turns_about_the_centroid_and_shifts() -> None:
    """target = R (v - c) + c + t."""
    euler, t = [0.3, 0.2, -0.5], np.array([1.0, 2.0, 3.0])
    v, c = np.array([0.7, -0.4, 2.0]), np.array([0.5, 0.5, 0.5])
    target = rotation_matrix(euler) @ (v - c) + c + t
    displacement = rigid_offset(euler, t) @ np.append(v - c, 1.0)
    assert v + displacement == pytest.approx(target, abs=1e-15)


def test_an_affine_offset_is_the_map_of_world_positions() -> None:
    rng = np.random.default_rng(1)
    matrix, v, c = rng.normal(size=(3, 4)), rng.normal(size=3), rng.normal(size=3)
    displacement = affine_offset(matrix, c) @ np.append(v - c, 1.0)
    assert v + displacement == pytest.approx(matrix @ np.append(v, 1.0), abs=1e-14)


def test_a_rigid_motion_has_the_same_offset_both_ways() -> None:
    c, t, euler = np.array([1.0, -2.0, 0.5]), np.array([0.1, 0.2, 0.3]), [0.4, 0.5, -0.6]
    R = rotation_matrix(euler)
    world = np.column_stack([R, c + t - R @ c])
    assert affine_offset(world, c) == pytest.approx(rigid_offset(euler, t), abs=1e-14)


def test_rotations_are_proper() -> None:
    R = rotation_matrix([3.0, -2.0, 0.1]) @ random_rotation()
    assert R @ R.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(R) == pytest.approx(1.0)
