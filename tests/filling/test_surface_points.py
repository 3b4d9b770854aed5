"""Points on a surface without large gaps between them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from snapspace.filling.surface_points import surface_points
from snapspace.generators import bar

from .surfaces import surface_of


@pytest.mark.parametrize("spacing", [0.07, 0.3, 5.0])
def test_every_point_of_the_surface_is_near_one_of_them(spacing: float) -> None:
    vertices, faces = surface_of(bar(1, 1, 1, length=2.0, width=1.0, height=0.5))
    points, face = surface_points(vertices, faces, spacing)
    assert np.array_equal(points[: len(vertices)], vertices)
    weights = np.random.default_rng(0).dirichlet([1.0, 1.0, 1.0], 300)
    anywhere = (weights @ vertices[faces]).reshape(-1, 3)
    assert cKDTree(points).query(anywhere)[0].max() < spacing
    assert (face[: len(vertices)] == -1).all() and (face[len(vertices) :] >= 0).all()
    a, b, c = (vertices[faces[face[len(vertices) :], corner]] for corner in range(3))
    above = np.einsum("ij,ij->i", points[len(vertices) :] - a, np.cross(b - a, c - a))
    np.testing.assert_allclose(above, 0.0, atol=1e-12)


def test_faces_with_short_edges_need_no_further_points() -> None:
    vertices, faces = surface_of(bar(8, 4, 2))
    assert np.array_equal(surface_points(vertices, faces, 10.0)[0], vertices)
