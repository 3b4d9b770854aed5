"""Stars of a radius: hats that sum to one, and a surface that bends alike however fine it is."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.transform import Rotation

from snapspace import ARAP, ElasticEnergy, ShellMesh
from snapspace import _core as core

from .sheets import equilateral, irregular, rolled, sheet, sphere

FloatArray = NDArray[np.float64]

RADIUS = 0.3
SQUARE = irregular(200)


def hats_of(mesh: ShellMesh, radius: float, shapes: FloatArray | None = None) -> core.StarHats:
    poses = mesh.vertices[None] if shapes is None else shapes
    return core.star_hats(np.ascontiguousarray(poses), mesh.triangles, radius)


def matrix_of(hats: core.StarHats, vertices: int) -> csr_array:
    starts, columns, weights = hats.rows()
    return csr_array((weights, columns, starts), shape=(len(hats), vertices))


def distances(mesh: ShellMesh) -> FloatArray:
    """Distances along edges between all vertices."""
    a, b = np.concatenate([mesh.triangles[:, [i, (i + 1) % 3]] for i in range(3)]).T
    lengths = np.linalg.norm(mesh.vertices[a] - mesh.vertices[b], axis=1)
    count = len(mesh.vertices)
    graph = np.full((count, count), np.inf)
    graph[a, b] = graph[b, a] = lengths
    return np.asarray(dijkstra(graph, directed=False))


def test_hats_sum_to_one_and_centers_cover_the_surface() -> None:
    hats = hats_of(SQUARE, RADIUS)
    matrix, far = matrix_of(hats, len(SQUARE.vertices)), distances(SQUARE)
    starts, columns, _ = hats.rows()
    centers = columns[starts[:-1]]
    assert 4 < len(centers) < 40
    np.testing.assert_allclose(matrix.sum(axis=0), 1.0, rtol=1e-14)
    apart = far[np.ix_(centers, centers)] + np.diag(np.full(len(centers), np.inf))
    assert apart.min() >= RADIUS * (1 - 1e-5)
    assert far[centers].min(axis=0).max() < RADIUS * (1 + 1e-5)
    hat = np.maximum(1 - far[centers] / (2 * RADIUS), 0.0) ** 2
    np.testing.assert_allclose(matrix.toarray(), hat / hat.sum(axis=0), atol=1e-4)


def test_a_mesh_has_the_same_stars_in_all_frames_and_units() -> None:
    ball = sphere(3)  # many of its edges have the same length
    hats = hats_of(ball, RADIUS).rows()
    turn = Rotation.from_rotvec([0.4, -1.0, 0.3]).as_matrix()
    for scale in (1.0, 1e-3):
        moved = scale * (ball.vertices @ turn.T + [3.0, 1.0, -2.0])
        for one, other in zip(hats, hats_of(ball, scale * RADIUS, moved[None]).rows(), strict=True):
            np.testing.assert_array_equal(one, other)


def test_edge_lengths_are_means_over_all_poses() -> None:
    ball = sphere(2)
    poses = np.stack([ball.vertices, 3.0 * ball.vertices])
    for one, other in zip(
        hats_of(ball, RADIUS, poses).rows(), hats_of(ball, RADIUS / 2).rows(), strict=True
    ):
        np.testing.assert_array_equal(one, other)


def test_where_edges_are_longer_the_stars_are_rings() -> None:
    x = rolled(SQUARE.vertices, 2.0, 0.4).reshape(-1)
    shortest = distances(SQUARE)[distances(SQUARE) > 0].min()
    radius = 0.4 * shortest / np.linalg.norm(np.ptp(SQUARE.vertices, axis=0))
    small = ElasticEnergy(SQUARE, ARAP(radius=radius))
    rings = ElasticEnergy(SQUARE, ARAP(radius=0.0))
    assert small.stars is not None and len(small.stars) == len(SQUARE.vertices)
    (value, gradient), (other, expected) = (e.value_and_gradient(x) for e in (small, rings))
    assert value == pytest.approx(other, rel=1e-13)
    np.testing.assert_allclose(gradient, expected, atol=1e-13 * np.abs(expected).max())


def test_a_finer_surface_bends_as_a_coarser_one() -> None:
    """With rings alone, a surface of half the edge length bends four times as easily."""

    def bending(n: int, radius: float) -> float:
        mesh = equilateral(n, n)
        bent = rolled(mesh.vertices, 0.5, 0.3)
        return ElasticEnergy(mesh, ARAP(radius=radius)).value(bent)

    assert bending(24, 0.0) == pytest.approx(4.0 * bending(48, 0.0), rel=0.1)
    coarse, fine, finest = (bending(n, 0.1) for n in (24, 48, 96))
    assert fine == pytest.approx(coarse, rel=0.1)
    assert finest == pytest.approx(fine, rel=0.1)
    assert bending(48, 0.2) > 2.5 * fine


@pytest.mark.parametrize("radius", [0.02, 0.04])
def test_a_surface_bends_as_a_plate_of_nearly_twice_the_radius(radius: float) -> None:
    """The plate has the same membrane. Both energies are those of a sheet rolled to a cylinder."""
    flat = sheet(120, 120, thickness=1.0, alternating=True)
    curvature, material = 0.5, ARAP(radius=radius)
    bent = ElasticEnergy(flat, material).value(rolled(flat.vertices, curvature))
    stiffness = 2.0 * bent / (curvature**2 * flat.areas.sum())  # D / thickness
    plate = (2.0 * material.mu + 2.0 / 3.0) / 12.0  # D / thickness^3, of lam = mu
    assert np.sqrt(stiffness / plate) == pytest.approx(1.8 * radius * flat.diagonal, rel=0.06)


def test_areas_of_stars_are_those_of_the_surface() -> None:
    for radius in (0.0, 0.2):
        stars = ElasticEnergy(SQUARE, ARAP(radius=radius)).stars
        assert stars is not None
        assert stars.measures.sum() == pytest.approx(SQUARE.areas.sum(), rel=1e-13)


def test_hats_are_pickled() -> None:
    hats = hats_of(SQUARE, RADIUS)
    for one, other in zip(hats.rows(), pickle.loads(pickle.dumps(hats)).rows(), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("radius", [-0.1, 1.1, np.nan, "wide", None])
def test_wrong_radii_are_refused(radius: object) -> None:
    with pytest.raises(ValueError, match=r"ARAP: radius is .*, but must be a number from 0 to 1"):
        ARAP(radius=radius)  # type: ignore[arg-type]
