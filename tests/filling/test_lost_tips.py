"""Thin tips that quick tets do not reach may be left out, but no part that joins others."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

from snapspace.filling import stuff_surface
from snapspace.filling.lost_tips import FEW, are_tips
from snapspace.generators import bar
from snapspace.mesh import MeshNotice, TetMesh, embed_surface
from snapspace.stuffing import stuff

from ..cli.odd_surfaces import ball
from .surfaces import Surface, surface_of

CELLS = 1200
EDGE = 0.1
#: The top vertex of `ball(40)`.
TOP = 3120


@pytest.fixture(scope="module")
def rings() -> np.ndarray:
    """The vertices of a long rod of one cell, (1201, 4): from one end to the other."""
    vertices, _ = rod()
    return np.argsort(vertices[:, 0], kind="stable").reshape(-1, 4)


@pytest.fixture(scope="module")
def rod_faces() -> np.ndarray:
    return rod()[1]


def rod() -> Surface:
    return surface_of(bar(CELLS, 1, 1, length=float(CELLS), width=1.0, height=1.0))


def test_an_end_is_a_tip(rings: np.ndarray, rod_faces: np.ndarray) -> None:
    assert are_tips(rings[0, :1], rod_faces)
    assert are_tips(rings[:3].ravel(), rod_faces)
    assert are_tips(rings[[0, -1]].ravel(), rod_faces), "both ends"


def test_a_part_of_one_side_is_a_tip(rings: np.ndarray, rod_faces: np.ndarray) -> None:
    """The top of a ridge, or a bump."""
    assert are_tips(rings[600, :1], rod_faces)


def test_what_joins_two_parts_is_no_tip(rings: np.ndarray, rod_faces: np.ndarray) -> None:
    assert not are_tips(rings[600], rod_faces)
    assert not are_tips(rings[[0, 600]].ravel(), rod_faces)


def test_many_vertices_are_no_tip(rings: np.ndarray, rod_faces: np.ndarray) -> None:
    few = int(FEW * rings.size / 4)
    assert are_tips(rings[:few].ravel(), rod_faces)
    assert not are_tips(rings[: few + 1].ravel(), rod_faces)


def ball_with_spike(length: float) -> Surface:
    """A unit ball whose top vertex is pulled away."""
    vertices, faces = ball(40)
    vertices[TOP, 2] += length
    return vertices, faces


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
        ValueError, match=f"1 of its vertices are far from the tets, vertex {TOP} first"
    ):
        stuff_surface(*ball_with_spike(3.0), edge_length=EDGE)
