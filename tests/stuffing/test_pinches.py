"""Tets that meet only at a point or along an edge are taken apart there."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.generators import bar
from snapspace.mesh.components import tet_components
from snapspace.stuffing import stuff
from snapspace.stuffing.isosurface_stuffing import stuff_unchecked
from snapspace.stuffing.largest_component import largest_component
from snapspace.stuffing.manifold import is_closed_manifold
from snapspace.stuffing.pinches import parted_at_pinches

Floats = np.ndarray


def glued(shift: tuple[float, float, float]) -> tuple[Floats, Floats]:
    """Two unit cubes, one of them shifted; vertices at the same place are one."""
    cube = bar(1, 1, 1, length=1.0, width=1.0, height=1.0)
    vertices = np.vstack([cube.vertices, cube.vertices + np.array(shift)])
    tets = np.vstack([cube.tets, cube.tets + len(cube.vertices)])
    places, renumbered = np.unique(vertices.round(9), axis=0, return_inverse=True)
    return places, renumbered.reshape(-1)[tets].astype(np.int32)


@pytest.mark.parametrize(
    ("shift", "copies", "parts"),
    [((1, 1, 1), 1, 2), ((1, 1, 0), 2, 2), ((1, 0, 0), 0, 1)],
    ids=["at a point", "along an edge", "at a face"],
)
def test_cubes_stay_together_only_at_a_face(
    shift: tuple[float, float, float], copies: int, parts: int
) -> None:
    vertices, tets = glued(shift)
    places, parted = parted_at_pinches(vertices, tets)
    assert len(places) == len(vertices) + copies
    assert np.array_equal(places[parted], vertices[tets])
    assert tet_components(parted, len(places)).max() + 1 == parts


def test_a_crumb_that_a_point_joins_is_left_out() -> None:
    """A cube, and a small one at its corner."""
    bodies = [bar(6, 6, 6, length=1.0, width=1.0, height=1.0), bar(1, 1, 1, length=0.1)]
    corner = bodies[0].vertices.max(axis=0) - bodies[1].vertices.min(axis=0)
    vertices = np.vstack([bodies[0].vertices, bodies[1].vertices + corner])
    tets = np.vstack([bodies[0].tets, bodies[1].tets + len(bodies[0].vertices)])
    places, renumbered = np.unique(vertices.round(9), axis=0, return_inverse=True)
    joined = renumbered.reshape(-1)[tets].astype(np.int32)
    assert tet_components(joined, len(places)).max() == 0, "a point joins both"
    _, kept = largest_component(*parted_at_pinches(places, joined))
    assert len(kept) == len(bodies[0].tets)


def test_a_pinched_shape_is_stuffed_without_the_crumb() -> None:
    """A blob of two cells beside a ball: the lattice joins them at an edge only."""
    center = np.array([-0.1071, 1.1381, -0.554])

    def shape(points: Floats) -> Floats:
        ball = np.linalg.norm(points, axis=1) - 1.0
        blob = np.linalg.norm(points - center, axis=1) - 0.2041
        return np.asarray(np.minimum(ball, blob))

    box = (-1.6, -1.6, -1.6), (1.6, 1.6, 1.6), 0.2
    whole, kept = stuff_unchecked(shape, *box), stuff(shape, *box)
    assert not is_closed_manifold(whole.surface) and is_closed_manifold(kept.surface)
    assert 0.98 * len(whole.tets) < len(kept.tets) < len(whole.tets)
    assert np.linalg.norm(whole.vertices, axis=1).max() > 1.4, "the far side of the blob"
    assert np.linalg.norm(kept.vertices, axis=1).max() < 1.2
