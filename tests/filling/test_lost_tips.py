"""Thin tips that quick tets do not reach may be left out, but no part that joins others."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

from snapspace.filling import stuff_surface
from snapspace.filling.lost_tips import FEW, are_tips
from snapspace.mesh import MeshNotice, TetMesh, embed_surface
from snapspace.stuffing import stuff

from .surfaces import Surface, tube

COLUMNS, RINGS = 3, 1200
EDGE = 0.1


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


def ball_with_spike(length: float) -> Surface:
    """A unit ball whose top vertex is pulled away."""
    latitudes = np.linspace(-np.pi / 2, np.pi / 2, 41)
    heights = np.sin(latitudes)
    heights[-1] += length
    return tube(np.cos(latitudes), heights, 40)


@pytest.fixture(scope="module")
def spiked() -> Surface:
    return ball_with_spike(0.6)


NOTICE = "leave out thin tips of the surface, 1 of its vertices, which follow the tets next to them"


def test_a_spike_is_left_out_with_a_notice_and_follows(spiked: Surface) -> None:
    vertices, faces = spiked
    with pytest.warns(MeshNotice, match=NOTICE):
        mesh = stuff_surface(vertices, faces, edge_length=EDGE)
    assert mesh.vertices[:, 2].max() < vertices[:, 2].max() - 0.2
    embedded = embed_surface(vertices, faces, mesh, farthest=np.inf)
    turn, shift = np.diag([1.0, -1.0, -1.0]), np.array([0.0, 1.0, 2.0])
    moved = embedded.vertices(mesh.vertices @ turn + shift)
    assert moved == pytest.approx(vertices @ turn + shift, abs=1e-9)


def test_a_shorter_edge_that_fails_leaves_the_tets_before_it(
    spiked: Surface, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(implicit: Any, low: Any, high: Any, cell: float, **options: Any) -> TetMesh:
        if cell < 0.9 * EDGE:
            raise ValueError("its surface is not a manifold")
        return stuff(implicit, low, high, cell, **options)

    monkeypatch.setattr(sys.modules[stuff_surface.__module__], "stuff", failing)
    with pytest.warns(MeshNotice, match=NOTICE):
        mesh = stuff_surface(*spiked, edge_length=EDGE)
    edges = mesh.vertices[mesh.tets[:, 0]] - mesh.vertices[mesh.tets[:, 1]]
    assert np.median(np.linalg.norm(edges, axis=1)) > 0.6 * EDGE * mesh.diagonal


def test_a_long_spike_is_no_tip() -> None:
    with pytest.raises(
        ValueError, match="1 of its vertices are far from the tets, vertex 1561 first"
    ):
        stuff_surface(*ball_with_spike(3.0), edge_length=EDGE)
