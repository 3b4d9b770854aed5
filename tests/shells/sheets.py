"""Surfaces for tests of shells: sheets of several triangulations, a fold and a sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from snapspace import ShellMesh

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int32]


def grid(nx: int, ny: int, *, alternating: bool = False) -> IntArray:
    """Triangles of a grid of nx times ny quads; their diagonals may alternate."""
    corner = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    turned = (np.add.outer(np.arange(nx), np.arange(ny)) % 2 == 1) & alternating
    first = np.where(turned[..., None], np.stack([a, b, d], -1), np.stack([a, b, c], -1))
    second = np.where(turned[..., None], np.stack([b, c, d], -1), np.stack([a, c, d], -1))
    return np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)]).astype(np.int32)


def sheet(
    nx: int = 6,
    ny: int = 4,
    *,
    size: tuple[float, float] = (1.5, 1.0),
    thickness: float = 0.05,
    alternating: bool = False,
) -> ShellMesh:
    """A flat rectangle in the plane z = 0 of right triangles, one corner at the origin."""
    x, y = np.linspace(0, size[0], nx + 1), np.linspace(0, size[1], ny + 1)
    vertices = np.stack([*np.meshgrid(x, y, indexing="ij"), np.zeros((nx + 1, ny + 1))], -1)
    faces = grid(nx, ny, alternating=alternating)
    return ShellMesh(vertices.reshape(-1, 3), faces, thickness=thickness)


def equilateral(nx: int, ny: int, *, length: float = 1.0, thickness: float = 0.05) -> ShellMesh:
    """A parallelogram of equilateral triangles; its first edges have the given length together."""
    i, j = np.meshgrid(np.arange(nx + 1), np.arange(ny + 1), indexing="ij")
    side = length / nx
    points = np.stack([side * (i - 0.5 * j), side * np.sqrt(0.75) * j, 0.0 * i], -1)
    return ShellMesh(points.reshape(-1, 3), grid(nx, ny), thickness=thickness)


def irregular(count: int, *, thickness: float = 0.05, seed: int = 0) -> ShellMesh:
    """The unit square with random vertices inside, and evenly spaced ones at its sides."""
    rng = np.random.default_rng(seed)
    per_side = max(2, round(np.sqrt(count)))
    t = np.linspace(0, 1, per_side + 1)[:-1]
    zero, one = np.zeros_like(t), np.ones_like(t)
    side = np.concatenate(
        [np.stack(pair, 1) for pair in ((t, zero), (one, t), (1 - t, one), (zero, 1 - t))]
    )
    inner = rng.uniform(0.5 / per_side, 1 - 0.5 / per_side, size=(count, 2))
    points = np.concatenate([side, inner])
    faces = Delaunay(points).simplices.astype(np.int32)
    a, b, c = (points[faces[:, k]] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    doubled = ux * vy - uy * vx
    faces = np.where((doubled < 0)[:, None], faces[:, ::-1], faces)[np.abs(doubled) > 1e-9]
    return ShellMesh(np.pad(points, ((0, 0), (0, 1))), faces, thickness=thickness)


def sphere(level: int = 1, *, radius: float = 1.0, thickness: float = 0.05) -> ShellMesh:
    """An icosahedron whose faces are divided into four, `level` times."""
    golden = (1 + np.sqrt(5)) / 2
    one = [[0, s, t * golden] for s in (-1, 1) for t in (-1, 1)]
    points = np.array([np.roll(p, k) for k in range(3) for p in one], np.float64)
    edge = np.linalg.norm(points[:, None] - points, axis=2)
    near = np.isclose(edge, 2.0)
    faces = np.array(
        [
            (i, j, k) if np.linalg.det(points[[i, j, k]]) > 0 else (i, k, j)
            for i in range(12)
            for j in range(i)
            for k in range(j)
            if near[i, j] and near[j, k] and near[i, k]
        ]
    )
    for _ in range(level):
        edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        unique, middle = np.unique(edges, axis=0, return_inverse=True)
        middle = middle.reshape(-1, 3) + len(points)
        points = np.concatenate([points, points[unique].mean(axis=1)])
        (a, b, c), (ab, bc, ca) = faces.T, middle.T
        quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = np.concatenate([np.stack(quarter, 1) for quarter in quarters])
    points *= radius / np.linalg.norm(points, axis=1, keepdims=True)
    return ShellMesh(points, faces.astype(np.int32), thickness=thickness)


def hinge(angle: float = 0.0, *, thickness: float = 0.1) -> ShellMesh:
    """Two irregular triangles that meet at an angle, zero in the plane."""
    return ShellMesh(hinge_vertices(angle), [[0, 1, 2], [1, 0, 3]], thickness=thickness)


def hinge_vertices(angle: float) -> FloatArray:
    """Vertices of `hinge`: the last one turns about the edge between the first two."""
    last = [0.7, -0.8 * np.cos(angle), 0.8 * np.sin(angle)]
    return np.array([[0.0, 0, 0], [1.2, 0, 0], [0.4, 0.9, 0], last])


def rolled(points: FloatArray, curvature: float, direction: float = 0.0) -> FloatArray:
    """Points (n, 3) of the plane z = 0 on a cylinder, an isometry; the direction is an angle."""
    along = np.array([np.cos(direction), np.sin(direction), 0.0])
    across = np.array([-along[1], along[0], 0.0])
    s, t = points @ along, points @ across
    up = np.array([0.0, 0.0, 1.0])
    return (
        (np.sin(curvature * s) / curvature)[:, None] * along
        + t[:, None] * across
        + ((1 - np.cos(curvature * s)) / curvature)[:, None] * up
    )


def bumpy(mesh: ShellMesh, size: float, seed: int = 0) -> FloatArray:
    """The mesh with noise of this size at every vertex, (3n,)."""
    noise = np.random.default_rng(seed).normal(size=mesh.vertices.shape)
    return (mesh.vertices + size * noise).reshape(-1)
