"""Animations: frames along a path through keys."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from snapspace import BlendingSession, InterpolationModel, PosingModel, PosingSession
from snapspace.session.trajectory import between_maps, key_shares

KEY: dict[str, Any] = {"head": ((0.2, 0.0, 0.4), (0.0, 0.1, 0.2))}


@pytest.fixture
def session(posing_model: PosingModel) -> PosingSession:
    return posing_model.session()


@pytest.mark.parametrize("easing", ["linear", "smooth"])
def test_an_animation_begins_here_and_ends_at_the_last_key(
    session: PosingSession, easing: str
) -> None:
    keys = [KEY, {"head": ((0, 0, 0), (0, 0, 0)), "belly": ((0.3, 0, 0), (0, 0, 0))}]
    shapes = []
    for report in session.animate(keys, frames=9, easing=easing):
        assert report.converged
        shapes.append(session.vertices)
    assert len(shapes) == 9
    rest = session.model.problem.mesh.vertices
    np.testing.assert_allclose(shapes[0], rest, atol=1e-9)
    for frame, key in ((4, keys[0]), (8, keys[1])):
        session.reset()
        session.move_all(key)
        np.testing.assert_allclose(shapes[frame], session.vertices, atol=1e-5)


def test_an_animation_starts_where_the_handles_are(session: PosingSession) -> None:
    session.move_all(KEY)
    before = session.vertices
    frames = session.animate([{"head": ((0, 0, 0), (0, 0, 0))}], frames=3)
    next(frames)
    np.testing.assert_allclose(session.vertices, before, atol=1e-6)


def test_centers_move_straight_and_bodies_turn_evenly() -> None:
    """The body turns about its centre and takes the shorter of the two rotations."""
    centers = np.array([[1.0, 2.0, 3.0]])
    turn = Rotation.from_rotvec([0.0, 0.0, 3.0])  # almost half a turn
    target = np.array([3.0, 2.0, 2.0])
    first = np.eye(3, 4)[None]
    matrix = turn.as_matrix()
    last = np.column_stack([matrix, target - matrix @ centers[0]])[None]
    path = list(between_maps(np.array([first, last]), centers, key_shares(5, 2, "linear")))
    for share, maps in zip(np.linspace(0, 1, 5), path, strict=True):
        position = maps[0, :, :3] @ centers[0] + maps[0, :, 3]
        np.testing.assert_allclose(position, (1 - share) * centers[0] + share * target, atol=1e-12)
        angle = Rotation.from_matrix(maps[0, :, :3]).as_rotvec()
        np.testing.assert_allclose(angle, [0.0, 0.0, 3.0 * share], atol=1e-12)


def test_smooth_legs_begin_and_end_slowly(session: PosingSession) -> None:
    heights = []
    for _ in session.animate([{"head": ((0, 0, 0), (0, 0, 0.4))}], frames=21):
        handle = session.model.problem.handles["head"].vertices
        heights.append(session.vertices[handle].mean(axis=0)[2])
    steps = np.diff(heights)
    assert steps[0] < 0.2 * steps.max() and steps[-1] < 0.2 * steps.max()


def test_blends_are_animated_through_weights(blending_model: InterpolationModel) -> None:
    session: BlendingSession = blending_model.session()
    count = len(blending_model.problem.poses)
    keys = list(np.eye(count)[:2])
    weights = [session.weights for _ in session.animate(keys, frames=5, easing="linear")]
    np.testing.assert_allclose(weights[0], blending_model.problem.domain.center)
    np.testing.assert_array_equal(weights[2], keys[0])
    np.testing.assert_array_equal(weights[4], keys[1])


@pytest.mark.parametrize(
    ("keys", "options", "message"),
    [
        ([], {}, "no keys are given"),
        ([KEY], {"frames": 1}, "frames is 1, but at least two are needed"),
        ([KEY], {"easing": "bouncy"}, "unknown easing 'bouncy'; known are linear, smooth"),
        ([{"nose": KEY["head"]}], {}, "nose"),
        ([{"head": ((0, 0), (0, 0, 0))}], {}, "animate: euler of 'head' needs three numbers"),
    ],
)
def test_bad_animations_are_refused_before_anything_moves(
    session: PosingSession, keys: Any, options: dict[str, Any], message: str
) -> None:
    before = session.vertices
    with pytest.raises(ValueError, match=message):
        session.animate(keys, **options)  # refused by the call, not by its first frame
    np.testing.assert_array_equal(session.vertices, before)


def test_affine_maps_cannot_be_animated(session: PosingSession) -> None:
    session.move_affine("head", np.column_stack([1.1 * np.eye(3), np.zeros(3)]))
    with pytest.raises(ValueError, match="that is not rigid; call reset"):
        session.animate([KEY])
