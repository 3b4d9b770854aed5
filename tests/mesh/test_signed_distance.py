"""SignedDistance: compared with the formula for a box and with searches among tets."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.generators import bar
from snapspace.mesh import compact_surface
from snapspace.mesh.signed_distance import SignedDistance
from snapspace.mesh.tet_search import closest_boundary_faces, containing_tets

from ..snapshots.creatures import creature


def test_it_is_that_of_a_box() -> None:
    """Points beyond faces, edges and corners have closest points of all three kinds."""
    mesh = bar(4, 2, 2, length=2.0, width=1.0, height=1.0)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    points = np.random.default_rng(0).uniform(low - 1.0, high + 1.0, (3000, 3))
    beyond = np.abs(points - (low + high) / 2.0) - (high - low) / 2.0
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    expected = outside + np.minimum(beyond.max(axis=1), 0.0)
    found = SignedDistance(*compact_surface(mesh.vertices, mesh.surface))(points)
    assert found == pytest.approx(expected, abs=1e-12)


def test_signs_and_sizes_are_those_of_the_tets() -> None:
    mesh = creature(5000)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    points = np.random.default_rng(1).uniform(low, high, (2000, 3))
    found = SignedDistance(*compact_surface(mesh.vertices, mesh.surface))(points)
    inside, _ = containing_tets(mesh, points)
    assert np.array_equal(found < 0, inside >= 0)
    _, sizes = closest_boundary_faces(mesh, points, limit=np.inf)
    assert np.abs(found) == pytest.approx(sizes, abs=1e-12)
