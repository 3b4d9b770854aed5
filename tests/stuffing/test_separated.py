"""Tets whose boundary touches itself are changed so that it does not."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.generators import bar
from snapspace.mesh import TetMesh, repair_tets
from snapspace.stuffing.manifold import is_closed_manifold
from snapspace.stuffing.separated import separated, touching_vertices

from ..generators.conforming import assert_solid


def block(*removed: tuple[int, int, int]) -> TetMesh:
    """A cube of 4 x 4 x 4 cells without some of these cells."""
    cube = bar(4, 4, 4, length=4.0, width=4.0, height=4.0)
    low = cube.vertices.min(axis=0)
    cells = np.floor(cube.vertices[cube.tets].mean(axis=1) - low).astype(int)
    gone = np.zeros(len(cells), bool)
    for cell in removed:
        gone |= (cells == cell).all(axis=1)
    mesh, _ = repair_tets(cube.vertices, cube.tets[~gone])
    return mesh


def test_tets_that_touch_nowhere_stay() -> None:
    mesh = block((1, 1, 1))
    assert len(touching_vertices(mesh.tets)) == 0
    vertices, tets = separated(mesh.vertices, mesh.tets)
    assert len(tets) == len(mesh.tets) and len(vertices) == len(mesh.vertices)


@pytest.mark.parametrize(
    ("removed", "euler"),
    [
        (((1, 1, 1), (2, 2, 2)), 4),
        (((1, 1, 1), (2, 2, 1)), 4),
        (((0, 0, 0), (1, 1, 1)), 2),
        (((0, 0, 1), (1, 1, 1)), 2),
    ],
    ids=[
        "holes that share a vertex",
        "holes that share an edge",
        "a hole at a missing corner",
        "a hole at a notch",
    ],
)
def test_parts_of_the_boundary_that_touch_are_joined_or_parted(
    removed: tuple[tuple[int, int, int], ...], euler: int
) -> None:
    """Holes that share a vertex become one; those that share an edge are parted in its middle."""
    mesh = block(*removed)
    assert not is_closed_manifold(mesh.surface)
    assert len(touching_vertices(mesh.tets))
    vertices, tets = separated(mesh.vertices, mesh.tets)
    parted = TetMesh(vertices, tets)
    assert is_closed_manifold(parted.surface)
    assert_solid(parted, euler=euler)
    assert parted.volume == pytest.approx(mesh.volume, rel=0.05)
