"""Generated meshes for the pictures: icospheres and a box."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]


def icosphere(levels: int) -> Mesh:
    """Unit sphere by subdividing an icosahedron, faces outward."""
    golden = (1.0 + np.sqrt(5.0)) / 2.0
    pairs = [(a, b) for a in (-1.0, 1.0) for b in (-golden, golden)]
    corners = [np.roll((0.0, a, b), turn) for turn in range(3) for a, b in pairs]
    vertices = np.array(corners) / np.hypot(1.0, golden)
    edge = np.min(np.linalg.norm(vertices[0] - vertices[1:], axis=1)) * 1.01
    near = np.linalg.norm(vertices[:, None] - vertices[None], axis=2) < edge
    faces = np.array(
        [
            (i, j, k)
            for i in range(12)
            for j in range(i + 1, 12)
            for k in range(j + 1, 12)
            if near[i, j] and near[j, k] and near[i, k]
        ]
    )
    for _ in range(levels):
        a, b, c = vertices[faces].transpose(1, 0, 2)
        points = np.concatenate([a, b, c, a + b, b + c, c + a])
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        vertices, index = np.unique(points.round(12), axis=0, return_inverse=True)
        i, j, k, ij, jk, ki = index.reshape(6, -1)
        faces = np.concatenate(
            [np.column_stack(t) for t in ((i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki))]
        )
    a, b, c = vertices[faces].transpose(1, 0, 2)
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0.0
    faces[inward] = faces[inward][:, ::-1]
    return vertices, faces.astype(np.int32)


@pytest.fixture(scope="session")
def sphere() -> Mesh:
    """642 vertices, 1280 faces."""
    return icosphere(3)


@pytest.fixture(scope="session")
def fine_sphere() -> Mesh:
    """10242 vertices, 20480 faces."""
    return icosphere(5)


@pytest.fixture(scope="session")
def box() -> Mesh:
    """Unit cube, 12 faces, outward."""
    vertices = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return vertices, np.array(faces, dtype=np.int32)
