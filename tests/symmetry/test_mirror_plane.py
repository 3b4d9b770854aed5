"""MirrorPlane: what a mirror does to positions, vectors, rotations and bounds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from snapspace import MirrorPlane
from snapspace.problem import rotation_matrix

seeds = st.integers(0, 10_000)
few = settings(max_examples=20)


def plane_of(seed: int) -> tuple[MirrorPlane, np.random.Generator]:
    rng = np.random.default_rng(seed)
    normal, point = rng.normal(size=(2, 3))
    return MirrorPlane(normal, point), rng


@few
@given(seeds)
def test_mirroring_twice_is_the_identity(seed: int) -> None:
    plane, rng = plane_of(seed)
    points, turns = rng.normal(size=(7, 3)), Rotation.random(7, random_state=seed).as_matrix()
    for mirror, values in (
        (plane.points, points),
        (plane.vectors, points),
        (plane.rotations, turns),
    ):
        np.testing.assert_allclose(mirror(mirror(values)), values, atol=1e-13)


@few
@given(seeds)
def test_points_of_the_plane_stay_and_the_middle_of_a_pair_is_on_it(seed: int) -> None:
    plane, rng = plane_of(seed)
    points = rng.normal(size=(7, 3))
    middle = (points + plane.points(points)) / 2.0
    np.testing.assert_allclose((middle - plane.point) @ plane.normal, 0, atol=1e-13)
    np.testing.assert_allclose(plane.points(middle), middle, atol=1e-13)
    assert np.linalg.norm(plane.normal) == pytest.approx(1, abs=1e-15)


@few
@given(seeds)
def test_a_mirrored_motion_moves_mirror_images(seed: int) -> None:
    """S (R v + t) = (H R H) (S v) + H t for a plane through the origin."""
    plane, rng = plane_of(seed)
    plane = MirrorPlane(plane.normal)
    turn, shift = Rotation.random(random_state=seed).as_matrix(), rng.normal(size=3)
    points = rng.normal(size=(7, 3))
    own, other = plane.rotations(turn), plane.vectors(shift)
    moved = plane.points(points) @ own.T + other
    np.testing.assert_allclose(moved, plane.points(points @ turn.T + shift), atol=1e-13)
    assert np.linalg.det(own) == pytest.approx(1)


def test_a_turn_about_the_normal_stays_and_others_are_reversed() -> None:
    plane = MirrorPlane((0, 0, 2))
    mirrored = plane.rotations(rotation_matrix(np.diag([0.3, 0.4, 0.5])))
    expected = rotation_matrix(np.diag([-0.3, -0.4, 0.5]))
    np.testing.assert_allclose(mirrored, expected, atol=1e-15)


@few
@given(seeds)
def test_mirrored_bounds_hold_the_mirror_image_of_the_box_and_no_less(seed: int) -> None:
    plane, rng = plane_of(seed)
    bounds = rng.uniform(0, 2, size=3)
    corners = bounds * np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
    reached = np.abs(plane.vectors(corners)).max(axis=0)
    np.testing.assert_allclose(plane.bounds(bounds), reached, rtol=1e-12)


@pytest.mark.parametrize("normal", [(1, 0, 0), (0, -3, 0), (0, 0, 1e-9)])
def test_bounds_stay_across_an_axis(normal: tuple[float, float, float]) -> None:
    assert MirrorPlane(normal).bounds([0.1, 0.2, 0.3]).tolist() == [0.1, 0.2, 0.3]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((0, 0, 0),), "the normal is zero; give the direction"),
        (((1, 0),), "the normal must be three finite numbers, got"),
        (((1, np.nan, 0),), "the normal must be three finite numbers"),
        (((1, 0, 0), (0, np.inf, 0)), "the point must be three finite numbers"),
        (("x",), "the normal must be three finite numbers, got 'x'"),
    ],
)
def test_bad_planes_are_refused(arguments: tuple[Any, ...], message: str) -> None:
    with pytest.raises(ValueError, match=f"^MirrorPlane: {message}"):
        MirrorPlane(*arguments)
