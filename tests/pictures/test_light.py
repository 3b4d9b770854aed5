"""Shadows fall where they should, and light comes from where the lamps are."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.pictures.camera import Camera
from snapspace.pictures.exposure import expose
from snapspace.pictures.ground import Ground, smoothed
from snapspace.pictures.lights import studio
from snapspace.pictures.shade import shade
from snapspace.pictures.shadow import ShadowCaster
from snapspace.pictures.surface import seen_surface

ABOVE = np.array([(0.0, 0.0, 1.0)])


def test_points_below_a_box_are_in_shadow_and_others_are_not(box):
    (shadow,) = ShadowCaster(*box).maps(ABOVE, resolution=64)
    below, beside, above = (0.5, 0.5, -1.0), (1.5, 0.5, -1.0), (0.5, 0.5, 1.2)
    points = np.array([below, beside, above], dtype=np.float32).T
    np.testing.assert_array_equal(shadow.lit(points), (0.0, 1.0, 1.0))
    np.testing.assert_array_equal(shadow.beside(points[:, :2]), (0.0, 1.0))


def test_area_of_a_slanted_shadow_is_the_closed_form(box):
    light = np.array([(0.6, 0.0, 0.8)])
    (shadow,) = ShadowCaster(*box).maps(light, resolution=200)
    x, y = np.meshgrid(np.linspace(-2, 2, 401), np.linspace(-1, 2, 301))
    ground = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)]).astype(np.float32)
    dark = (1.0 - shadow.beside(ground)).sum() * 0.01**2
    # The unit footprint plus the smear of the unit height, 0.6 / 0.8.
    assert dark == pytest.approx(1.75, rel=0.02)


def test_an_open_surface_shades_from_both_sides():
    vertices = np.array([(0.0, 0, 0), (4, 0, 0), (0, 4, 0)])
    below = np.array([(1.0,), (1.0,), (-1.0,)], dtype=np.float32)
    for faces in (np.array([(0, 1, 2)]), np.array([(0, 2, 1)])):
        (shadow,) = ShadowCaster(vertices, faces.astype(np.int32)).maps(ABOVE, resolution=32)
        assert shadow.lit(below)[0] == 0.0


def test_the_sphere_is_brightest_towards_the_key_light(sphere):
    vertices, faces = sphere
    camera = Camera.framing(vertices, width=60, height=60)
    light = studio(-60.0, "z")
    seen = seen_surface(vertices, faces, np.full_like(vertices, 0.5), camera, samples=1)
    radiance, _ = shade(seen.points, vertices, faces, light, None, pixels=60)
    brightness = radiance.mean(axis=0)
    facing = light.lamps[0].center @ seen.points.normal
    # The border turned to the rim light has its own highlight.
    inner = light.lamps[2].center @ seen.points.normal < 0.1
    brightness, facing = brightness[inner], facing[inner]
    assert facing[np.argsort(brightness)[-50:]].min() > 0.8
    assert np.corrcoef(brightness, np.clip(facing, 0, None))[0, 1] > 0.9
    assert brightness[facing > 0.95].min() > 2.0 * brightness[facing < -0.1].mean()


def test_a_convex_shape_is_open_to_the_whole_sky(sphere):
    vertices, faces = sphere
    light = studio(0.0, "z")
    caster = ShadowCaster(vertices, faces)
    points = (vertices * 1.05).T.astype(np.float32)
    for shadow in caster.maps(light.sphere[::8], resolution=96):
        towards = shadow.light @ points > 0.25
        assert np.all(shadow.lit(points[:, towards]) == 1.0)


def test_the_sky_is_a_full_sphere_of_even_directions():
    light = studio(30.0, "y")
    np.testing.assert_allclose(np.linalg.norm(light.sphere, axis=1), 1.0)
    np.testing.assert_allclose(light.sphere.mean(axis=0), 0.0, atol=0.01)
    second = light.sphere.T @ light.sphere / len(light.sphere)
    np.testing.assert_allclose(second, np.eye(3) / 3.0, atol=0.01)


def test_the_studio_turns_with_the_camera():
    turned, first = studio(70.0, "z"), studio(-20.0, "z")
    quarter = np.array([(0, -1, 0), (1, 0, 0), (0, 0, 1)])
    for a, b in zip(first.lamps, turned.lamps, strict=True):
        np.testing.assert_allclose(quarter @ a.center, b.center, atol=1e-12)


def test_ground_is_darkest_at_the_contact_and_open_far_away(sphere):
    vertices, faces = sphere[0] * 0.5, sphere[1]
    camera = Camera.framing(vertices, width=30, height=30, elevation=30.0)
    ground = Ground.below(vertices, up="z", level=-0.5, nodes=128)
    exposure = expose(
        vertices,
        faces,
        np.full_like(vertices, 0.5),
        camera,
        studio(-60.0, "z"),
        ground,
        samples=1,
    )
    brightness = exposure.ground.brightness
    assert brightness[64, 64] < 0.3
    assert brightness.min() > 0.0
    border = np.concatenate([brightness[0], brightness[-1], brightness[:, 0], brightness[:, -1]])
    assert np.all(border == 1.0)


def test_ground_has_no_picture_from_below(sphere):
    ground = Ground.below(sphere[0], up="z", level=-1.0, nodes=32)
    ground = ground.lit_by(np.zeros(32 * 32, dtype=np.float32))
    below = Camera.framing(sphere[0], width=16, height=16, elevation=-40.0)
    above = Camera.framing(sphere[0], width=16, height=16, elevation=40.0)
    assert np.all(ground.in_picture(below) == 1.0)
    assert ground.in_picture(above).min() < 0.5


def test_smoothing_keeps_even_light_and_the_total():
    even = np.full(40 * 40, 0.7, dtype=np.float32)
    np.testing.assert_allclose(smoothed(even, passes=5), even, rtol=1e-6)
    spot = np.zeros((41, 41), dtype=np.float32)
    spot[20, 20] = 1.0
    blurred = smoothed(spot.ravel(), passes=8).reshape(41, 41)
    assert blurred.sum() == pytest.approx(1.0, abs=1e-5)
    variance = (blurred.sum(axis=0) * (np.arange(41) - 20) ** 2).sum()
    assert variance == pytest.approx(8 / 2, rel=1e-4)
