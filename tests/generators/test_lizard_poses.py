"""The lizard: poses of one mesh that differ and are valid, whatever the seed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from snapspace import Poses
from snapspace.generators import lizard_poses
from snapspace.generators.bent_rod import bent_rod
from snapspace.generators.lizard_grid import LIMBS, lizard_grid
from snapspace.mesh import tet_volumes

from .conforming import assert_solid


@given(
    count=st.integers(2, 6),
    tets=st.integers(500, 6_000),
    seed=st.integers(0, 2**32),
    bend=st.floats(0.05, 2.0),
)
@settings(max_examples=40)
def test_no_tet_is_inverted_and_poses_differ(count: int, tets: int, seed: int, bend: float) -> None:
    poses = lizard_poses(count, tets, seed=seed, bend=bend)
    assert len(poses) == count
    rest = tet_volumes(poses[0].vertices, poses[0].tets)
    for i, pose in enumerate(poses):
        assert np.array_equal(pose.tets, poses[0].tets)
        # bending thins the inner side, but limbs keep their volume as a whole
        assert (tet_volumes(pose.vertices, pose.tets) > 0.2 * rest).all()
        assert pose.volume == pytest.approx(poses[0].volume, rel=0.1)
        for other in poses[:i]:
            assert np.abs(pose.vertices - other.vertices).max() > 0.05 * bend


@pytest.mark.parametrize("tets", [500, 1_000, 1_700, 4_000, 11_000, 20_000, 60_000])
def test_the_number_of_tets_is_met(tets: int) -> None:
    (mesh,) = lizard_poses(1, tets)
    assert len(mesh.tets) == pytest.approx(tets, rel=0.1)


@pytest.mark.parametrize("tets", [500, 4_000])
def test_is_one_solid_body_in_every_pose(tets: int) -> None:
    for pose in lizard_poses(3, tets, seed=5):
        assert_solid(pose, euler=2)


def test_the_straight_lizard_has_the_known_volume() -> None:
    """A torso, and frustums with square sections."""

    def frustum(length: float, tip: float) -> float:
        return length * 0.25**2 * (1 + tip + tip**2) / 3

    limbs = sum(frustum(limb.length, limb.tip) for limb in LIMBS)
    coarse, fine = (lizard_poses(1, tets)[0].volume for tets in (1_000, 60_000))
    assert fine == pytest.approx(0.375 + limbs, rel=1e-3)
    assert coarse == pytest.approx(0.375 + limbs, rel=0.02)


def test_a_pose_depends_on_seed_and_number_alone() -> None:
    twice = [lizard_poses(20, 600, seed=3) for _ in range(2)]
    assert [mesh.fingerprint for mesh in twice[0]] == [mesh.fingerprint for mesh in twice[1]]
    fewer = lizard_poses(4, 600, seed=3)
    assert [mesh.fingerprint for mesh in fewer] == [mesh.fingerprint for mesh in twice[0][:4]]
    other = lizard_poses(4, 600, seed=4)
    assert other[0].fingerprint == fewer[0].fingerprint
    assert not np.allclose(other[1].vertices, fewer[1].vertices)


def test_the_shape_does_not_depend_on_the_resolution() -> None:
    tips = []
    for tets in (1_000, 20_000):
        grid, pose = lizard_grid(tets), lizard_poses(2, tets, seed=1)[1]
        ends = []
        for limb, points in zip(LIMBS, grid.limbs, strict=True):
            along = limb.sign * grid.vertices[points, limb.axis]
            last = points[along > along.max() - 1e-9]
            ends.append((pose.vertices[last].min(axis=0) + pose.vertices[last].max(axis=0)) / 2)
        tips.append(ends)
    np.testing.assert_allclose(tips[0], tips[1], atol=1e-12)


def test_the_tail_is_bent_most() -> None:
    """The poses are meant to be far apart: its tip moves by a good part of its length of 2.5."""
    poses = lizard_poses(20, 1_000)
    tip = poses[0].vertices[:, 0].argmin()
    moved = [np.linalg.norm((pose.vertices - poses[0].vertices)[tip]) for pose in poses[1:]]
    assert np.median(moved) > 1.0


def test_a_rod_keeps_its_length_and_does_not_fold() -> None:
    s, centre, frames = bent_rod(np.array([[2.0, 1.0], [9.0, -4.0], [-7.0, 3.0]]), 2.0, (0.2, 0.1))
    steps = np.linalg.norm(np.diff(centre, axis=0), axis=1)
    np.testing.assert_allclose(steps, s[1], rtol=1e-12)
    np.testing.assert_allclose(frames @ frames.transpose(0, 2, 1), [np.eye(3)] * len(s), atol=1e-12)
    curvature = np.linalg.norm(np.diff(frames[:, :, 0], axis=0), axis=1) / s[1]
    assert 0.3 < (curvature * (0.2 - 0.05 * (s[1:] + s[:-1]) / 2)).max() < 0.55


def test_a_rod_without_bends_is_straight() -> None:
    s, centre, frames = bent_rod(np.zeros((3, 2)), 3.0, (0.2, 0.1))
    np.testing.assert_allclose(centre, s[:, None] * [1.0, 0.0, 0.0], atol=1e-14)
    assert np.array_equal(frames, np.broadcast_to(np.eye(3), frames.shape))


def test_they_are_valid_poses() -> None:
    poses = Poses.of(lizard_poses(3, 500))
    assert poses.inverted_tets.tolist() == [0, 0, 0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"count": 0}, "lizard_poses: count is 0, but must be at least 1"),
        ({"count": 2.5}, "lizard_poses: count is 2.5, but must be a whole number"),
        ({"tets": 499}, "lizard_poses: tets is 499, but must be at least 500"),
        ({"tets": 500_001}, "lizard_poses: tets is 500001, but must be at most 500000"),
        ({"seed": -1}, "lizard_poses: seed is -1, but must be at least 0"),
        ({"bend": 0.0}, "lizard_poses: bend is 0.0, but must be positive"),
        ({"bend": 2.1}, "lizard_poses: bend is 2.1, but must be at most 2"),
        ({"bend": float("nan")}, "lizard_poses: bend is nan, but must be finite"),
    ],
)
def test_refuses(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        lizard_poses(**{"count": 2, **arguments})
