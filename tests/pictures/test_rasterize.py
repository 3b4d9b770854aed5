"""Which pixels a triangle covers, at which depth, and in front of what."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace.pictures.rasterize import barycentric, rasterize

ONE = np.array([(0, 1, 2)], dtype=np.int32)


def covered(points, faces, width, height):
    return rasterize(points, faces, width=width, height=height).triangle_image() >= 0


def test_triangle_over_half_of_the_frame_covers_the_pixels_whose_centres_it_holds():
    width, height = 70, 40
    points = np.array([(0.0, 0.0, 1.0), (width, 0.0, 1.0), (0.0, height, 1.0)])
    y, x = np.mgrid[:height, :width] + 0.5
    expected = x / width + y / height < 1.0
    assert np.array_equal(covered(points, ONE, width, height), expected)
    assert np.array_equal(covered(points, ONE[:, ::-1], width, height), expected)


def test_pixel_centres_on_a_shared_diagonal_belong_to_exactly_one_triangle():
    square = np.array([(0.0, 0.0, 1.0), (32, 0.0, 1.0), (32, 32, 1.0), (0.0, 32, 1.0)])
    halves = [np.array([t], dtype=np.int32) for t in ((0, 1, 2), (0, 2, 3))]
    total = sum(covered(square, half, 32, 32).astype(int) for half in halves)
    assert np.all(total == 1)


@given(
    x=st.floats(0.5, 28.5),
    y=st.floats(0.5, 22.5),
    steps=st.lists(st.floats(0.01, 0.99), min_size=0, max_size=5),
)
def test_a_fan_of_triangles_tiles_the_frame_without_gap_or_overlap(x, y, steps):
    left = [(0.0, 23.0 * step) for step in sorted(set(steps), reverse=True)]
    border = [(0.0, 0.0), (29.0, 0.0), (29.0, 23.0), (0.0, 23.0), *left]
    points = np.array([(*corner, 0.0) for corner in [(x, y), *border]])
    count = len(border)
    total = np.zeros((23, 29), dtype=int)
    for i in range(count):
        total += covered(points, np.array([(0, 1 + i, 1 + (i + 1) % count)]), 29, 23)
    assert np.all(total == 1)


def test_depth_of_a_tilted_plane_is_exact():
    corners = np.array([(-5.0, -5.0), (90.0, -5.0), (90.0, 70.0), (-5.0, 70.0)])
    plane = 0.3 * corners[:, 0] - 0.7 * corners[:, 1] + 11.0
    points = np.column_stack([corners, plane])
    faces = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32)
    y, x = np.mgrid[:60, :80] + 0.5
    depth = rasterize(points, faces, width=80, height=60).depth_image()
    np.testing.assert_allclose(depth, 0.3 * x - 0.7 * y + 11.0, atol=1e-11)


def test_visibility_does_not_depend_on_the_order_of_the_triangles():
    rng = np.random.default_rng(4)
    points = np.column_stack([rng.uniform(-10, 90, (300, 2)), rng.uniform(0, 1, 300)])
    faces = np.arange(300, dtype=np.int32).reshape(100, 3)
    order = rng.permutation(100)
    one = rasterize(points, faces, width=80, height=64)
    two = rasterize(points, faces[order], width=80, height=64)
    assert np.array_equal(one.pixel, two.pixel)
    assert np.array_equal(one.depth, two.depth)
    assert np.array_equal(one.triangle, order[two.triangle])
    assert len(np.unique(one.triangle)) > 20


def test_the_nearest_of_all_triangles_over_a_pixel_is_seen():
    rng = np.random.default_rng(8)
    points = np.column_stack([rng.uniform(0, 40, (90, 2)), rng.uniform(-3, 2, 90)])
    faces = np.arange(90, dtype=np.int32).reshape(30, 3)
    alone = [
        rasterize(points, faces[i : i + 1], width=40, height=40).depth_image() for i in range(30)
    ]
    raster = rasterize(points, faces, width=40, height=40)
    np.testing.assert_allclose(raster.depth_image(), np.min(alone, axis=0), atol=1e-11)
    ids = raster.triangle_image()
    inside = ids >= 0
    assert np.array_equal(ids[inside], np.argmin(alone, axis=0)[inside])


def test_triangles_beyond_the_frame_are_cut_at_its_border():
    points = np.array([(-1e6, -1e6, 0.0), (3e6, -1e6, 0.0), (-1e6, 3e6, 0.0)])
    assert covered(points, ONE, 17, 9).all()
    assert not covered(points + np.array((5e6, 0.0, 0.0)), ONE, 17, 9).any()


def test_triangles_without_area_are_not_seen():
    line = np.array([(1.0, 1.0, 0.0), (9.0, 9.0, 0.0), (5.0, 5.0, 0.0)])
    level = np.array([(1.0, 4.5, 0.0), (9.0, 4.5, 0.0), (5.0, 4.5, 0.0)])
    for points in (line, level):
        assert not covered(points, ONE, 10, 10).any()


def test_barycentric_coordinates_reproduce_the_place_and_the_depth():
    rng = np.random.default_rng(2)
    points = np.column_stack([rng.uniform(0, 60, (60, 2)), rng.uniform(1, 2, 60)])
    faces = rng.permutation(60).reshape(20, 3).astype(np.int32)
    raster = rasterize(points, faces, width=60, height=60)
    x, y = raster.centers()
    weights = barycentric(points, faces, raster.triangle, x, y)
    place = np.einsum("ki,kij->kj", weights, points[faces[raster.triangle]])
    np.testing.assert_allclose(place, np.column_stack([x, y, raster.depth]), atol=1e-9)
    assert weights.min() >= 0.0


@pytest.mark.parametrize("thickness", [1e-3, 1e-9, 1e-300])
def test_slivers_keep_the_depth_of_their_corners(thickness):
    points = np.array([(0.0, 8.5, 1.0), (30.0, 8.5 + thickness, 2.0), (15.0, 8.5, 1.5)])
    depth = rasterize(points, ONE, width=30, height=16).depth
    assert np.all((depth >= 1.0) & (depth <= 2.0))
