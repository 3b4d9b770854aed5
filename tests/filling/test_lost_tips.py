"""Thin tips that quick tets do not reach may be left out, but no part that joins others."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.filling import stuff_surface
from snapspace.filling.lost_tips import FEW, are_tips
from snapspace.mesh import MeshNotice, embed_surface

from .surfaces import tube

COLUMNS, RINGS = 3, 1200


@pytest.fixture(scope="module")
def rod_faces() -> np.ndarray:
    radii = np.ones(RINGS + 2)
    radii[[0, -1]] = 0.0
    return tube(radii, np.linspace(0.0, 1.0, RINGS + 2), COLUMNS)[1]


def ring(number: int) -> np.ndarray:
    return 1 + COLUMNS * number + np.arange(COLUMNS)


def test_an_end_is_a_tip(rod_faces: np.ndarray) -> None:
    assert are_tips(np.array([0]), rod_faces)
    assert are_tips(np.concatenate([[0], ring(0), ring(1)]), rod_faces)
    both = np.array([0, 1 + COLUMNS * RINGS])
    assert are_tips(both, rod_faces)


def test_a_part_of_one_side_is_a_tip(rod_faces: np.ndarray) -> None:
    """The top of a ridge, or a bump."""
    assert are_tips(ring(600)[:1], rod_faces)


def test_what_joins_two_parts_is_none(rod_faces: np.ndarray) -> None:
    assert not are_tips(ring(600), rod_faces)
    assert not are_tips(np.concatenate([[0], ring(600)]), rod_faces)


def test_many_vertices_are_none(rod_faces: np.ndarray) -> None:
    rings = int(FEW * rod_faces.max() / COLUMNS) + 1
    assert not are_tips(np.concatenate([ring(k) for k in range(rings)]), rod_faces)


def test_a_spike_is_left_out_with_a_notice() -> None:
    latitudes = np.linspace(-np.pi / 2, np.pi / 2, 41)
    heights = np.sin(latitudes)
    heights[-1] += 0.6
    vertices, faces = tube(np.cos(latitudes), heights, 40)
    with pytest.warns(MeshNotice, match="leave out thin tips of the surface, 1 of its vertices"):
        mesh = stuff_surface(vertices, faces, edge_length=0.1)
    assert mesh.vertices[:, 2].max() < heights[-1] - 0.2
    with_tip = embed_surface(vertices, faces, mesh, farthest=np.inf)
    moved = mesh.vertices @ np.diag([1.0, -1.0, -1.0]) + [0.0, 1.0, 2.0]
    turned = vertices @ np.diag([1.0, -1.0, -1.0]) + [0.0, 1.0, 2.0]
    assert with_tip.vertices(moved) == pytest.approx(turned, abs=1e-9)
