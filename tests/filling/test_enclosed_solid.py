"""EnclosedSolid: the union of overlapping parts."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace.filling.closed_input import closed_input
from snapspace.filling.enclosed_solid import EnclosedSolid
from snapspace.generators import bar

from .surfaces import Surface, beside, box, inside_out, surface_of

BODY = box(0.0, 0.0, 0.0)
ARM = box(1.6, 0.3, 0.4, size=(1.25, 0.5, 0.5))
SIZES = ((2.0, 1.0, 1.0), (1.25, 0.5, 0.5))
LOWS = np.array([[0.0, 0.0, 0.0], [1.6, 0.3, 0.4]])


def solid(surface: Surface) -> EnclosedSolid:
    return EnclosedSolid(closed_input(*surface, who="test"))


def depth(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """How deep points are inside each of the two boxes, (2, k); negative outside."""
    gaps = [
        np.minimum(points - low, low + size - points) for low, size in zip(LOWS, SIZES, strict=True)
    ]
    return np.array([gap.min(axis=1) for gap in gaps])


def test_points_are_inside_if_they_are_in_any_part() -> None:
    surface = beside(BODY, ARM)
    given = closed_input(*surface, who="test")
    points = np.random.default_rng(0).uniform([-0.5, -0.5, -0.5], [3.5, 1.5, 1.5], (3000, 3))
    found = solid(surface).distance((points - given.center) / given.diagonal)
    assert np.array_equal(found < 0, depth(points).max(axis=0) > 0)
    outside = found > 0
    beyond = [
        np.maximum(np.maximum(low - points, points - low - size), 0.0)
        for low, size in zip(LOWS, SIZES, strict=True)
    ]
    exact = np.linalg.norm(beyond, axis=2).min(axis=0)
    assert given.diagonal * found[outside] == pytest.approx(exact[outside], abs=1e-12)


def test_vertices_are_exposed_unless_they_are_in_another_part() -> None:
    surface = beside(BODY, ARM)
    made = solid(surface)
    assert made.overlaps
    assert np.array_equal(made.exposed, depth(surface[0]).max(axis=0) < 1e-9)


def test_points_of_its_boundary_are_not_buried() -> None:
    """Also those on faces that are partly buried."""
    surface = beside(BODY, ARM)
    given = closed_input(*surface, who="test")
    made = solid(surface)
    points = given.center + given.diagonal * made.points(0.02, clear=0.0)
    assert depth(points).max(axis=0).max() < 1e-9
    assert len(points) > 4 * len(surface[0])


def test_points_in_a_narrow_gap_between_overlapping_parts_are_left_out() -> None:
    """A lid above a body is held by a post."""
    post, lid = box(0.25, 0.25, 0.75, size=(0.5, 0.5, 0.5)), box(0.0, 0.0, 1.1)
    given = closed_input(*beside(BODY, post, lid), who="test")
    made = EnclosedSolid(given)
    exposed, clear = (
        given.center + given.diagonal * made.points(0.03, clear=distance / given.diagonal)
        for distance in (0.09, 0.11)
    )
    for points, are_left in ((exposed, True), (clear, False)):
        level = np.isclose(points[:, 2], 1.0) | np.isclose(points[:, 2], 1.1)
        inner = (np.abs(points[:, :2] - [1.0, 0.5]) < [0.99, 0.49]).all(axis=1)
        beside_post = (np.abs(points[:, :2] - 0.5) > 0.26).any(axis=1)
        assert (level & inner & beside_post).any() == are_left


def test_a_hollow_body_does_not_overlap() -> None:
    hollow = beside(BODY, inside_out(box(0.5, 0.25, 0.25, size=(0.5, 0.5, 0.5))))
    assert not solid(hollow).overlaps
    assert solid(beside(BODY, box(0.5, 0.25, 0.25, size=(0.5, 0.5, 0.5)))).overlaps


def test_bars_that_cross_without_a_vertex_inside_overlap() -> None:
    bars = [bar(1, 1, 1, length=1.0, width=0.05, height=0.05) for _ in range(2)]
    (lengthwise, faces), (crosswise, _) = (surface_of(one) for one in bars)
    cross = beside(
        (lengthwise - lengthwise.mean(axis=0), faces),
        ((crosswise - crosswise.mean(axis=0))[:, [1, 2, 0]], faces),
    )
    made = solid(cross)
    assert made.exposed.all() and made.overlaps
