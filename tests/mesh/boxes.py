"""Meshes for these tests: boxes of cells of six tets each."""

from __future__ import annotations

from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from snapspace.mesh import TetMesh

Arrays = tuple[NDArray[np.float64], NDArray[np.int32]]


def box_arrays(
    cells: tuple[int, int, int] = (2, 2, 2), size: tuple[float, float, float] = (1.0, 1.0, 1.0)
) -> Arrays:
    """Vertices and tets of Kuhn's subdivision: one tet for each order of the axes in each cell."""
    counts = np.array(cells) + 1
    index = np.arange(counts.prod()).reshape(counts)
    vertices = np.stack(np.unravel_index(index.ravel(), counts), axis=1) * np.divide(size, cells)
    lowest = index[:-1, :-1, :-1].ravel()
    steps = np.array([counts[1] * counts[2], counts[2], 1])
    tets = []
    for order in permutations(range(3)):
        corners = np.cumsum([0, *steps[list(order)]])
        if np.linalg.det(np.eye(3)[list(order)]) < 0:
            corners = corners[[0, 2, 1, 3]]
        tets.append(lowest[:, None] + corners)
    return vertices, np.stack(tets, axis=1).reshape(-1, 4).astype(np.int32)


def box_mesh(
    cells: tuple[int, int, int] = (2, 2, 2), size: tuple[float, float, float] = (1.0, 1.0, 1.0)
) -> TetMesh:
    return TetMesh(*box_arrays(cells, size))


def irregular_mesh() -> TetMesh:
    """A box whose coordinates use all digits of a double."""
    vertices, tets = box_arrays((3, 2, 2), (1.0, 0.7, 0.9))
    noise = np.random.default_rng(5).uniform(-0.02, 0.02, vertices.shape)
    return TetMesh(vertices + noise, tets)
