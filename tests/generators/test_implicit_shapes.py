from __future__ import annotations

import numpy as np
import pytest

from snapspace.generators.blended_shape import blended, limb, lump
from snapspace.generators.implicit_shapes import bent_cone, ellipsoid, smooth_union, sphere

POINTS = np.random.default_rng(0).uniform(-2.0, 2.0, (2000, 3))


def test_straight_bent_cone_is_the_hull_of_two_balls() -> None:
    control = np.array([[0.0, 0.0, 0.0, 0.5], [1.0, 0.5, 0.0, 0.2]])
    t = np.linspace(0.0, 1.0, 20001)[:, None]
    balls = (1.0 - t) * control[0] + t * control[1]
    brute = [(np.linalg.norm(p - balls[:, :3], axis=1) - balls[:, 3]).min() for p in POINTS[:300]]
    np.testing.assert_allclose(bent_cone(POINTS[:300], control), brute, atol=1e-7)


def test_bent_cone_is_the_nearest_ball_on_the_curve() -> None:
    control = np.array([[-1, 0, 0, 0.3], [-0.5, 1, 0, 0.2], [0.5, 0, 1, 0.1], [1, 0.5, 0.5, 0.2]])
    t = np.linspace(0.0, 1.0, 20001)[:, None]
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    balls = sum(w * c for w, c in zip(weights, control, strict=True))
    brute = [(np.linalg.norm(p - balls[:, :3], axis=1) - balls[:, 3]).min() for p in POINTS[:300]]
    values = bent_cone(POINTS[:300], control)
    near = np.abs(brute) < 0.5
    np.testing.assert_allclose(values[near], np.array(brute)[near], atol=1e-5)
    np.testing.assert_allclose(values, brute, atol=2e-3)


def test_ellipsoid_has_the_exact_zero_set_and_is_a_ball_for_equal_radii() -> None:
    radii = np.array([0.5, 1.0, 1.5])
    unit = POINTS / np.linalg.norm(POINTS, axis=1, keepdims=True)
    assert np.abs(ellipsoid(unit * radii + 0.1, [0.1] * 3, radii)).max() < 1e-12
    np.testing.assert_allclose(
        ellipsoid(POINTS, [0.0] * 3, [0.7] * 3), sphere(POINTS, [0.0] * 3, 0.7), atol=1e-12
    )
    turn = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    np.testing.assert_allclose(
        ellipsoid(POINTS @ turn, [0.0] * 3, radii, turn), ellipsoid(POINTS, [0.0] * 3, radii)
    )


def test_smooth_union_is_the_union_away_from_the_crease() -> None:
    a, b = sphere(POINTS, [0.5, 0, 0], 0.8), sphere(POINTS, [-0.5, 0, 0], 0.8)
    union = smooth_union(a, b, 0.2)
    plain = np.minimum(a, b)
    far = np.abs(a - b) >= 0.2
    assert far.any() and not far.all()
    assert np.array_equal(union[far], plain[far])
    assert (union <= plain).all() and (union >= plain - 0.05).all()
    assert smooth_union(np.zeros(1), np.zeros(1), 0.2)[0] == pytest.approx(-0.05)


def test_parts_that_are_skipped_do_not_matter() -> None:
    parts = (
        limb([(-1, 0, 0, 0.3), (0, 1, 0, 0.2), (1, 0, 0, 0.3)], blend=0.1),
        lump((1.0, 1.0, 0.5), (0.3, 0.3, 0.3), blend=0.2),
        limb([(0, 0, -1, 0.4), (0, 0, 1, 0.2)], blend=0.3),
    )
    expected = parts[0].value(POINTS)
    for part in parts[1:]:
        expected = smooth_union(expected, part.value(POINTS), part.blend)
    np.testing.assert_allclose(blended(POINTS, parts), expected, atol=1e-14)
