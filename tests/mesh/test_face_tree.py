"""FaceTree: the closest faces, compared with trying all of them."""

from __future__ import annotations

import igl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import _core as core
from snapspace.generators import bar

from .face_distances import distances_from_faces

SEEDS = st.integers(0, 2**32 - 1)


def soup(rng: np.random.Generator, count: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Triangles that intersect each other, of all sizes."""
    sizes = np.exp(rng.normal(size=(count, 1, 1)))
    corners = 3 * rng.normal(size=(count, 1, 3)) + sizes * rng.normal(size=(count, 3, 3))
    return corners.reshape(-1, 3), np.arange(3 * count, dtype=np.int32).reshape(-1, 3)


@settings(max_examples=30)
@given(SEEDS, st.integers(1, 30))
def test_faces_are_those_of_trying_every_face(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    vertices, faces = soup(rng, count)
    points = 4 * rng.normal(size=(40, 3))
    found, distances, feet = core.FaceTree(vertices, faces).closest(points, np.inf)
    every = distances_from_faces(points, vertices, faces)
    assert distances == pytest.approx(every.min(axis=1), rel=1e-9)
    assert every[np.arange(40), found] == pytest.approx(distances, rel=1e-9)
    assert np.linalg.norm(feet - points, axis=1) == pytest.approx(distances, rel=1e-12)


@settings(max_examples=30)
@given(SEEDS)
def test_the_closest_point_is_on_the_face(seed: int) -> None:
    """Its barycentric coordinates are not negative, also beyond edges and corners."""
    rng = np.random.default_rng(seed)
    vertices, faces = soup(rng, 20)
    points = 4 * rng.normal(size=(40, 3))
    found, _, feet = core.FaceTree(vertices, faces).closest(points, np.inf)
    corners = vertices[faces[found]]
    for foot, corner in zip(feet, corners, strict=True):
        system = np.vstack([corner.T, np.ones(3)])
        weights, *_ = np.linalg.lstsq(system, np.append(foot, 1.0), rcond=None)
        assert weights.min() > -1e-6 and weights @ corner == pytest.approx(foot, abs=1e-6)


def test_triangles_without_area_are_segments_or_points() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [3, 0, 0], [2, 2, 2]], float)
    faces = np.array([[0, 1, 2], [3, 3, 3]], np.int32)
    points = np.array([[2.5, 1.0, 0.0], [2.0, 3.0, 2.0], [-1.0, 0.0, 0.0]])
    found, _, feet = core.FaceTree(vertices, faces).closest(points, np.inf)
    assert found.tolist() == [0, 1, 0]
    assert feet.tolist() == [[2.5, 0, 0], [2, 2, 2], [0, 0, 0]]


def test_beyond_the_limit_there_is_no_face() -> None:
    vertices, faces = np.eye(3), np.array([[0, 1, 2]], np.int32)
    points = np.array([[2.0, 0, 0], [2.5, 0, 0]])
    found, distances, feet = core.FaceTree(vertices, faces).closest(points, 1.0)
    assert found.tolist() == [0, -1], "the limit itself is within it"
    assert distances.tolist() == [1.0, np.inf] and np.isnan(feet[1]).all()


def test_the_first_of_equally_close_faces_is_found_in_any_order_of_points() -> None:
    """Points start from each other's closest faces, which must not decide."""
    vertices, faces = bar(8, 4, 4).vertices, bar(8, 4, 4).surface
    every = np.concatenate([faces, faces])  # each face twice
    tree = core.FaceTree(vertices, every)
    points = np.random.default_rng(0).uniform(-1, 4, (3000, 3))
    found, distances, _ = tree.closest(points, np.inf)
    assert (found < len(faces)).all()
    order = np.random.default_rng(1).permutation(len(points))
    assert np.array_equal(tree.closest(points[order], np.inf)[0], found[order])
    for threads in (1, 2, 3):
        assert np.array_equal(tree.closest(points, np.inf, threads)[1], distances)


@settings(max_examples=20)
@given(SEEDS)
def test_winding_numbers_are_those_of_the_solid_angles(seed: int) -> None:
    """Of bars that overlap, one of them inside out."""
    rng = np.random.default_rng(seed)
    vertices, faces = [], []
    for part in range(4):
        mesh = bar(2, 1, 1, length=2.0, width=1.0, height=1.0)
        turned = mesh.surface if part else mesh.surface[:, ::-1]
        faces.append(turned + part * len(mesh.vertices))
        turn = Rotation.random(random_state=int(rng.integers(1 << 30)))
        vertices.append(mesh.vertices @ turn.as_matrix() + rng.normal(scale=0.4, size=3))
    surface = np.concatenate(vertices), np.concatenate(faces).astype(np.int32)
    points = rng.normal(size=(200, 3))
    found = core.FaceTree(*surface).windings(points)
    np.testing.assert_allclose(found, igl.winding_number(*surface, points), atol=1e-9)


def test_rays_through_edges_and_corners_count_once() -> None:
    """The points are in rows with the vertices, which rays meet on their way."""
    mesh = bar(6, 4, 4, length=3.0, width=2.0, height=2.0)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    axes = [
        np.linspace(a - 0.25, b + 0.25, int(4 * (b - a)) + 3)
        for a, b in zip(low, high, strict=True)
    ]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    clear = (np.abs(points - low) > 1e-9).all(axis=1) & (np.abs(points - high) > 1e-9).all(axis=1)
    inside = ((points > low) & (points < high)).all(axis=1)
    found = core.FaceTree(mesh.vertices, mesh.surface).windings(points)
    assert np.array_equal(found[clear], inside[clear])
    assert clear.sum() > 500


def test_windings_do_not_depend_on_the_number_of_threads() -> None:
    rng = np.random.default_rng(0)
    mesh = bar(4, 3, 2)
    tree, points = core.FaceTree(mesh.vertices, mesh.surface), rng.normal(size=(2000, 3))
    assert np.array_equal(tree.windings(points, threads=1), tree.windings(points, threads=2))
