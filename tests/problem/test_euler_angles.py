"""Angles of rotations: the inverse of `rotation_matrix`, also at gimbal lock."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace.problem import euler_of_rotation, rotation_matrix

from ..shapes import random_rotation

FloatArray = NDArray[np.float64]
full_turn = st.floats(-np.pi, np.pi)
level = st.floats(-1.5, 1.5)
# distances from a quarter turn: zero, rounding errors, and what the formulas must resolve
near_lock = st.sampled_from([0.0, 1e-17, 1e-15, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3])


@settings(max_examples=200)
@given(alpha=full_turn, beta=level, gamma=full_turn)
def test_angles_come_back(alpha: float, beta: float, gamma: float) -> None:
    angles = np.array([alpha, beta, gamma])
    found = euler_of_rotation(rotation_matrix(angles))
    # a half turn and minus a half turn are the same
    turns = (found - angles) / (2 * np.pi)
    np.testing.assert_allclose(turns, np.rint(turns), rtol=0, atol=1e-14)
    assert (np.abs(found) <= [np.pi, np.pi / 2, np.pi]).all()


@settings(max_examples=200)
@given(alpha=full_turn, gamma=full_turn, off=near_lock, side=st.sampled_from([-1.0, 1.0]))
def test_the_rotation_comes_back_at_gimbal_lock(
    alpha: float, gamma: float, off: float, side: float
) -> None:
    """The angles may differ, but they give the same rotation to the last digits."""
    rotation = rotation_matrix([alpha, side * (np.pi / 2 - off), gamma])
    found = euler_of_rotation(rotation)
    np.testing.assert_allclose(rotation_matrix(found), rotation, rtol=0, atol=4e-15)


@settings(max_examples=100)
@given(seed=st.integers(0, 2**32 - 1))
def test_any_rotation_comes_back(seed: int) -> None:
    rotation = random_rotation(seed)
    found = euler_of_rotation(rotation)
    np.testing.assert_allclose(rotation_matrix(found), rotation, rtol=0, atol=4e-15)
    np.testing.assert_allclose(found, Rotation.from_matrix(rotation).as_euler("xyz"), atol=1e-7)


@pytest.mark.parametrize("side", [-1, 1])
def test_at_gimbal_lock_alpha_is_zero(side: int) -> None:
    """Many angles give the rotation; those about only two axes are chosen."""
    alpha, beta, gamma = euler_of_rotation([[0, 0, side], [0, 1, 0], [-side, 0, 0]])
    assert (alpha, beta, gamma) == (0.0, side * np.pi / 2, 0.0)
    turned = rotation_matrix([0.3, side * np.pi / 2, 1.0])
    found = euler_of_rotation(turned)
    assert found == pytest.approx([0.0, side * np.pi / 2, 1.0 - side * 0.3], abs=1e-15)


def test_the_identity_has_no_angles() -> None:
    assert not euler_of_rotation(np.eye(3)).any()


@pytest.mark.parametrize("signs", [(1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
def test_half_turns_come_back(signs: tuple[int, int, int]) -> None:
    rotation = np.diag(np.array(signs, float))
    found = rotation_matrix(euler_of_rotation(rotation))
    np.testing.assert_allclose(found, rotation, rtol=0, atol=1e-15)


def test_many_rotations_at_once() -> None:
    angles = np.random.default_rng(0).uniform(-1.5, 1.5, (5, 2, 3))
    rotations = rotation_matrix(angles)
    found = euler_of_rotation(rotations)
    assert found.shape == (5, 2, 3)
    np.testing.assert_array_equal(found[3, 1], euler_of_rotation(rotations[3, 1]))
    np.testing.assert_allclose(found, angles, rtol=0, atol=1e-13)
