"""Cells along a Morton curve: the same mesh, in an order that depends on places alone."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.generators import cylinder
from snapspace.mesh.arrays import FloatArray, IndexArray
from snapspace.mesh.morton_order import morton_order


@pytest.fixture(scope="module")
def shuffled() -> tuple[FloatArray, IndexArray]:
    mesh, rng = cylinder(12, 24, length=2.0, radius=1.0), np.random.default_rng(0)
    order = rng.permutation(len(mesh.vertices))
    faces = np.argsort(order).astype(np.int32)[mesh.surface]
    return mesh.vertices[order], faces[rng.permutation(len(faces))]


def corners(vertices: FloatArray, cells: IndexArray) -> set[bytes]:
    return {corner.tobytes() for corner in vertices[cells]}


def test_the_mesh_is_the_same(shuffled: tuple[FloatArray, IndexArray]) -> None:
    ordered = morton_order(*shuffled)
    assert corners(*ordered) == corners(*shuffled)
    assert len(ordered[0]) == len(shuffled[0]) and len(ordered[1]) == len(shuffled[1])


def test_cells_in_a_row_are_neighbours(shuffled: tuple[FloatArray, IndexArray]) -> None:
    def typical_step(vertices: FloatArray, cells: IndexArray) -> float:
        centers = vertices[cells].mean(axis=1)
        return float(np.median(np.linalg.norm(np.diff(centers, axis=0), axis=1)))

    vertices, cells = shuffled
    edge = np.median(np.linalg.norm(vertices[cells[:, 0]] - vertices[cells[:, 1]], axis=1))
    assert typical_step(*morton_order(vertices, cells)) < 2.0 * edge
    assert typical_step(vertices, cells) > 5.0 * edge
