"""Searches among tets and faces, compared with trying all of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from snapspace.mesh import TetMesh, repair_tets
from snapspace.mesh.box_tree import BoxTree
from snapspace.mesh.tet_search import (
    barycentric,
    closest_boundary_faces,
    containing_tets,
    least_extrapolated,
)

from .face_distances import distances_from_faces

SEEDS = st.integers(0, 2**32 - 1)


def random_mesh(rng: np.random.Generator) -> TetMesh:
    """A part of a Delaunay mesh: not convex, with tets of all shapes."""
    points = rng.normal(size=(30, 3))
    tets = Delaunay(points).simplices
    mesh, _ = repair_tets(points, tets[rng.random(len(tets)) < 0.8])
    return mesh


@settings(max_examples=40)
@given(SEEDS, st.integers(1, 40))
def test_the_tree_finds_what_trying_every_box_finds(seed: int, boxes: int) -> None:
    rng = np.random.default_rng(seed)
    low = rng.integers(0, 6, (boxes, 3)).astype(float)  # integers: boxes touch and coincide
    high = low + rng.integers(0, 3, (boxes, 3))
    points = rng.integers(-1, 9, (50, 3)).astype(float)
    distances = rng.integers(0, 3, 50).astype(float)
    gap = np.maximum(np.maximum(low - points[:, None], points[:, None] - high), 0)
    expected = np.argwhere((gap**2).sum(axis=2) <= distances[:, None] ** 2)
    point, box = BoxTree(low, high).within(points, distances)
    assert (np.diff(point) >= 0).all()
    assert sorted([p, b] for p, b in zip(point, box, strict=True)) == expected.tolist()


@settings(max_examples=15)
@given(SEEDS)
def test_containing_tets_are_those_of_trying_every_tet(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mesh = random_mesh(rng)
    points = rng.normal(size=(100, 3))
    tets, weights = containing_tets(mesh, points)
    every = np.arange(len(mesh.tets))
    for point, tet, weight in zip(points, tets, weights, strict=True):
        depth = barycentric(mesh.vertices[mesh.tets], point[None].repeat(len(every), 0)).min(axis=1)
        if tet < 0:
            assert depth.max() < 0 and np.isnan(weight).all()
        else:
            assert tet == depth.argmax() and weight.min() >= -1e-12
            assert weight @ mesh.vertices[mesh.tets[tet]] == pytest.approx(point, abs=1e-9)


@settings(max_examples=15)
@given(SEEDS)
def test_closest_faces_are_those_of_trying_every_face(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mesh = random_mesh(rng)
    points = 2 * rng.normal(size=(50, 3))
    faces, distances = closest_boundary_faces(mesh, points, limit=1.5)
    every = distances_from_faces(points, mesh.vertices, mesh.surface)
    near = every.min(axis=1) <= 1.5
    assert np.array_equal(faces >= 0, near) and (distances[~near] == np.inf).all()
    assert distances[near] == pytest.approx(every.min(axis=1)[near], rel=1e-12)
    assert every[near, faces[near]] == pytest.approx(distances[near], rel=1e-12)


def test_the_least_extrapolated_tet_is_around_the_face() -> None:
    rng = np.random.default_rng(0)
    mesh = random_mesh(rng)
    points = 2 * rng.normal(size=(50, 3))
    faces, _ = closest_boundary_faces(mesh, points, limit=np.inf)
    tets, weights = least_extrapolated(mesh, points, faces)
    for point, face, tet, weight in zip(points, faces, tets, weights, strict=True):
        around = np.flatnonzero(np.isin(mesh.tets, mesh.surface[face]).any(axis=1))
        found = barycentric(mesh.vertices[mesh.tets[around]], point[None].repeat(len(around), 0))
        size = np.abs(found).sum(axis=1)
        assert tet == around[size.argmin()]
        assert np.array_equal(weight, found[size.argmin()])


def test_more_points_than_a_block_have_the_same_answers() -> None:
    rng = np.random.default_rng(1)
    mesh = random_mesh(rng)
    points = rng.normal(size=(9000, 3))
    tets, weights = containing_tets(mesh, points)
    some = rng.choice(9000, 200, replace=False)
    few_tets, few_weights = containing_tets(mesh, points[some])
    assert np.array_equal(tets[some], few_tets)
    assert np.array_equal(weights[some], few_weights, equal_nan=True)
    faces, _ = closest_boundary_faces(mesh, points, limit=np.inf)
    assert np.array_equal(faces[some], closest_boundary_faces(mesh, points[some], limit=np.inf)[0])
