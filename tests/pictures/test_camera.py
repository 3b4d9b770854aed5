"""The camera frames its points, and projects them as a pinhole does."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.pictures.camera import Camera, direction

VIEWS = [(-60.0, 15.0, "z"), (200.0, -30.0, "y"), (10.0, 90.0, "x"), (0.0, 0.0, "z")]


def cloud(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(200, 3)) * (3.0, 1.0, 0.5) + (7.0, -4.0, 2.0)


@pytest.mark.parametrize(("azimuth", "elevation", "up"), VIEWS)
@pytest.mark.parametrize("size", [(300, 200), (200, 300)])
def test_the_points_touch_the_inner_frame_on_two_opposite_sides(azimuth, elevation, up, size):
    camera = Camera.framing(
        cloud(1),
        width=size[0],
        height=size[1],
        azimuth=azimuth,
        elevation=elevation,
        up=up,
        margin=0.1,
    )
    screen = camera.project(cloud(1))
    inner = (screen[:, :2] / size - 0.5) / 0.45
    assert np.abs(inner).max() == pytest.approx(1.0, abs=1e-9)
    tight = int(np.argmax(np.abs(inner).max(axis=0)))
    assert inner[:, tight].min() == pytest.approx(-1.0, abs=1e-9)
    assert inner[:, tight].max() == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(("azimuth", "elevation", "up"), VIEWS)
def test_the_axes_are_a_right_handed_frame_towards_the_eye(azimuth, elevation, up):
    camera = Camera.framing(
        cloud(2), width=10, height=10, azimuth=azimuth, elevation=elevation, up=up
    )
    frame = np.stack([camera.right, camera.up, camera.back])
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(frame) == pytest.approx(1.0)
    np.testing.assert_allclose(camera.back, direction(azimuth, elevation, up))


@pytest.mark.parametrize(
    ("up", "azimuth", "expected"),
    [
        ("z", 0, (1, 0, 0)),
        ("z", 90, (0, 1, 0)),
        ("y", 0, (0, 0, 1)),
        ("y", 90, (1, 0, 0)),
        ("x", 0, (0, 1, 0)),
        ("x", 90, (0, 0, 1)),
    ],
)
def test_azimuth_turns_about_the_up_axis(up, azimuth, expected):
    np.testing.assert_allclose(direction(azimuth, 0.0, up), expected, atol=1e-15)
    top = direction(azimuth, 90.0, up)
    assert top["xyz".index(up)] == pytest.approx(1.0)


def test_depth_is_affine_on_the_screen():
    camera = Camera.framing(cloud(3), width=64, height=48)
    a, b = cloud(3)[:2]
    line = a + np.linspace(0.0, 1.0, 7)[:, None] * (b - a)
    screen = camera.project(line)
    along = (screen[:, 0] - screen[0, 0]) / (screen[-1, 0] - screen[0, 0])
    expected = screen[0, 2] + along * (screen[-1, 2] - screen[0, 2])
    np.testing.assert_allclose(screen[:, 2], expected, rtol=1e-12)


def test_rays_go_through_the_projections():
    camera = Camera.framing(cloud(4), width=64, height=48)
    screen = camera.project(cloud(4))
    hit = camera.eye + camera.rays(screen[:, 0], screen[:, 1]) / -screen[:, 2:]
    np.testing.assert_allclose(hit, cloud(4), atol=1e-10)


def test_scaled_and_extended_views_agree_with_the_first():
    camera = Camera.framing(cloud(5), width=64, height=48)
    screen = camera.project(cloud(5))
    np.testing.assert_allclose(camera.scaled(3).project(cloud(5)), screen * (3, 3, 1))
    moved = screen + np.array((5, 9, 0))
    np.testing.assert_allclose(camera.extended(5, 9).project(cloud(5)), moved)


def test_a_single_point_is_seen_in_the_middle():
    point = np.array([(1.0, 2.0, 3.0)])
    camera = Camera.framing(point, width=40, height=20)
    np.testing.assert_allclose(camera.project(point)[0, :2], (20.0, 10.0), atol=1e-6)


def test_points_behind_the_eye_are_refused():
    camera = Camera.framing(cloud(6), width=40, height=20)
    with pytest.raises(ValueError, match=r"Camera: point 0 at .* is behind the eye"):
        camera.project(camera.eye[None] + camera.back)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"up": "w"}, r"up is 'w'; choose 'x', 'y' or 'z'"),
        ({"azimuth": np.nan}, r"azimuth is nan; give a finite angle"),
        ({"elevation": np.inf}, r"elevation is inf; give a finite angle"),
        ({"field_of_view": 180.0}, r"field_of_view is 180.0; give degrees between"),
        ({"margin": 1.0}, r"margin is 1.0; give a fraction"),
    ],
)
def test_impossible_views_are_refused(options, message):
    with pytest.raises(ValueError, match=message):
        Camera.framing(cloud(7), width=40, height=20, **options)
