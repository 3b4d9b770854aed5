"""closest_corners: a vertex of the closest triangle for each point."""

from __future__ import annotations

import numpy as np

from snapspace.generators import bar
from snapspace.mesh import compact_surface
from snapspace.mesh.closest_corners import closest_corners

SQUARE = np.array([[0.0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def test_on_a_fine_surface_it_is_the_closest_vertex() -> None:
    box = bar(6, 6, 6, length=1.0, width=1.0, height=1.0)
    vertices, faces = compact_surface(box.vertices, box.surface)
    points = vertices + 1e-3 * np.random.default_rng(0).normal(size=vertices.shape)
    assert closest_corners(vertices, faces, points).tolist() == list(range(len(vertices)))


def test_it_is_a_corner_of_the_closest_triangle_and_not_of_another_limb() -> None:
    """Above the middle of a large square, with a small triangle farther above."""
    small = np.array([[5.0, 4, 1], [5.1, 4, 1], [5, 4.1, 1]])
    vertices, faces = np.vstack([SQUARE, small]), np.vstack([FACES, [[4, 5, 6]]]).astype(np.int32)
    points = np.array([[5.0, 4.0, 0.1], [5.0, 4.0, 0.9], [9.0, 1.0, 0.1], [1.0, 9.0, -3.0]])
    found = closest_corners(vertices, faces, points)
    assert found[0] < 4 and found[1] >= 4
    assert found[2:].tolist() == [1, 3]
