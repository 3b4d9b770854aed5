"""Normals and the points at which a seen surface is shaded."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.pictures.camera import Camera
from snapspace.pictures.normals import corner_normals, face_normals
from snapspace.pictures.surface import seen_surface


def test_normals_of_a_sphere_point_outward_along_the_radius(sphere):
    vertices, faces = sphere
    cosine = np.einsum("fij,fij->fi", corner_normals(vertices, faces), vertices[faces])
    assert cosine.min() > 0.999


def test_a_box_keeps_its_edges(box):
    corners = corner_normals(*box)
    expected = np.repeat(face_normals(*box)[:, None], 3, axis=1)
    np.testing.assert_allclose(corners, expected, atol=1e-14)


def test_without_a_crease_the_corners_of_a_box_are_smooth_however_it_is_triangulated(box):
    vertices, faces = box
    corners = corner_normals(vertices, faces, crease=180.0)
    outward = (vertices[faces] - 0.5) / np.sqrt(0.75)
    np.testing.assert_allclose(corners, outward, atol=1e-14)


def test_silhouette_area_of_a_sphere_is_the_closed_form(fine_sphere):
    vertices, faces = fine_sphere
    camera = Camera.framing(vertices, width=200, height=200, margin=0.1)
    seen = seen_surface(vertices, faces, np.ones_like(vertices), camera, samples=3)
    distance = np.linalg.norm(camera.eye)
    radius = camera.focal / np.sqrt(distance**2 - 1.0)
    assert seen.share.sum() == pytest.approx(np.pi * radius**2, rel=0.01)


def test_interpolation_is_correct_in_perspective(sphere):
    vertices, faces = sphere
    camera = Camera.framing(vertices, width=80, height=60, field_of_view=80.0)
    slope = np.array([(0.1, 0.2, 0.3), (-0.3, 0.1, 0.0), (0.0, 0.0, 0.2)])
    seen = seen_surface(vertices, faces, vertices @ slope + 0.5, camera, samples=2)
    position = seen.points.position.T.astype(np.float64)
    np.testing.assert_allclose(seen.points.albedo.T, position @ slope + 0.5, atol=1e-6)
    screen = camera.project(position)
    row, column = np.divmod(seen.pixel, 80)
    assert np.abs(screen[:, 0] - column - 0.5).max() < 0.5
    assert np.abs(screen[:, 1] - row - 0.5).max() < 0.5


def test_supersampling_turns_the_edge_into_intermediate_coverage(sphere):
    vertices, faces = sphere
    camera = Camera.framing(vertices, width=50, height=50)
    fine, coarse = (
        np.bincount(seen.pixel, weights=seen.share, minlength=2500)
        for samples in (4, 1)
        for seen in [seen_surface(vertices, faces, np.ones_like(vertices), camera, samples=samples)]
    )
    assert set(np.unique(coarse)) == {0.0, 1.0}
    edge = (fine > 0.0) & (fine < 1.0)
    assert 60 < edge.sum() < 250
    exact = seen_surface(vertices, faces, np.ones_like(vertices), camera, samples=8)
    truth = np.bincount(exact.pixel, weights=exact.share, minlength=2500)
    assert np.abs(fine - truth).sum() < 0.3 * np.abs(coarse - truth).sum()


def test_shares_of_a_pixel_sum_to_its_coverage(box):
    vertices, faces = box
    camera = Camera.framing(vertices, width=40, height=40)
    seen = seen_surface(vertices, faces, np.ones_like(vertices), camera, samples=3)
    total = np.bincount(seen.pixel, weights=seen.share)
    assert total.max() <= 1.0 + 1e-12
    # Three faces of the box are seen: pixels on its edges have a point on each side.
    assert len(seen.pixel) > len(np.unique(seen.pixel))


def test_the_inner_side_of_an_open_surface_is_shaded_towards_the_eye():
    vertices = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)])
    camera = Camera.framing(vertices, width=20, height=20, elevation=60.0)
    for faces in (np.array([(0, 1, 2)]), np.array([(0, 2, 1)])):
        seen = seen_surface(vertices, faces, np.ones_like(vertices), camera, samples=1)
        assert np.all(seen.points.normal[2] > 0.99)
