"""embed_surface: surface vertices as weighted corners of tets."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from snapspace.mesh import TetMesh, boundary_surface, embed_surface

from .boxes import box_mesh, irregular_mesh

NO_FACES = np.zeros((0, 3), dtype=int)


def affine(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.normal(size=(3, 3)), rng.normal(size=3)


def near(mesh: TetMesh, count: int, *, seed: int = 0, outside: float = 0.015) -> np.ndarray:
    """Random points of the bounding box, enlarged by a share `outside` of the diagonal."""
    margin = outside * mesh.diagonal / np.sqrt(3)
    low, high = mesh.vertices.min(axis=0) - margin, mesh.vertices.max(axis=0) + margin
    return np.random.default_rng(seed).uniform(low, high, (count, 3))


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_affine_motions_of_the_tets_are_those_of_the_surface(seed: int) -> None:
    mesh = box_mesh((3, 2, 2), (1.0, 0.7, 0.9))
    points = near(mesh, 60, seed=seed)
    surface = embed_surface(points, NO_FACES, mesh)
    matrix, shift = affine(seed)
    assert surface.vertices(mesh.vertices) == pytest.approx(points, abs=1e-13)
    moved = surface.vertices(mesh.vertices @ matrix.T + shift)
    assert moved == pytest.approx(points @ matrix.T + shift, abs=1e-12)


def test_points_inside_have_the_weights_of_their_tet() -> None:
    mesh = irregular_mesh()
    rng = np.random.default_rng(1)
    tet = rng.integers(len(mesh.tets), size=200)
    weights = rng.dirichlet(np.ones(4), size=200)
    points = np.einsum("sk,skc->sc", weights, mesh.vertices[mesh.tets[tet]])
    surface = embed_surface(points, NO_FACES, mesh)
    assert np.array_equal(surface.corners, mesh.tets[tet])
    assert surface.weights == pytest.approx(weights, abs=1e-10)


def test_surface_vertices_at_tet_vertices_follow_them() -> None:
    mesh = irregular_mesh()
    order = np.random.default_rng(2).permutation(len(mesh.vertices))
    jitter = np.random.default_rng(3).uniform(-4e-10, 4e-10, mesh.vertices.shape)
    surface = embed_surface((mesh.vertices + jitter * mesh.diagonal)[order], NO_FACES, mesh)
    assert surface.exact
    x = np.random.default_rng(4).normal(size=mesh.vertices.shape)
    assert np.array_equal(surface.vertices(x), x[order])


def test_midpoints_of_edges_follow_their_ends() -> None:
    mesh = irregular_mesh()
    ends = mesh.tets[:, [1, 3]]
    surface = embed_surface(mesh.vertices[ends].mean(axis=1), NO_FACES, mesh)
    x = np.random.default_rng(5).normal(size=mesh.vertices.shape)
    assert surface.vertices(x) == pytest.approx(x[ends].mean(axis=1), abs=1e-10)


def test_a_surface_kept_by_the_mesher_is_embedded_exactly_with_its_own_faces() -> None:
    """Tetrahedralisers that keep the surface put its vertices first."""
    mesh = irregular_mesh()
    count = len(mesh.vertices) // 2
    faces = np.array([[2, 1, 0], [5, 3, 4]])
    surface = embed_surface(mesh.vertices[:count] + 1e-10, faces, mesh)
    assert surface.exact
    assert np.array_equal(surface.faces, faces)
    assert surface.corners[:, 0].tolist() == list(range(count))


def test_the_embedded_boundary_is_the_boundary() -> None:
    mesh = irregular_mesh()
    own = boundary_surface(mesh)
    surface = embed_surface(own.vertices(mesh.vertices), own.faces, mesh)
    x = np.random.default_rng(6).normal(size=mesh.vertices.shape)
    assert np.array_equal(surface.vertices(x), own.vertices(x))


def test_outside_a_sliver_the_weights_stay_small() -> None:
    """The tet behind the closest face is flat; its neighbour is not."""
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 1e-4], [0.3, 0.3, -1]]
    mesh = TetMesh(vertices, [[0, 1, 2, 3], [0, 2, 1, 4]])
    point = np.array([[0.32, 0.3, 0.01]])
    surface = embed_surface(point, NO_FACES, mesh)
    assert np.abs(surface.weights).max() < 2
    assert surface.vertices(mesh.vertices) == pytest.approx(point)


def test_a_point_follows_its_own_limb_even_if_another_would_extrapolate_less() -> None:
    """Two prongs with a gap: points in the gap follow the prong that is closer."""
    box = box_mesh((5, 1, 5), (5.0, 1.0, 5.0))
    middle = box.vertices[box.tets].mean(axis=1)
    gap = (middle[:, 0] > 2) & (middle[:, 0] < 3) & (middle[:, 2] > 1)
    used, tets = np.unique(box.tets[~gap], return_inverse=True)
    mesh = TetMesh(box.vertices[used], tets.reshape(-1, 4))
    points = np.array([[2.1, 0.5, 4.6], [2.9, 0.5, 4.6]])
    surface = embed_surface(points, NO_FACES, mesh)
    assert mesh.vertices[surface.corners[0], 0].max() <= 2
    assert mesh.vertices[surface.corners[1], 0].min() >= 3


def test_units_and_frames_do_not_matter() -> None:
    mesh = irregular_mesh()
    points = near(mesh, 100, seed=7, outside=-0.01)
    surface = embed_surface(points, NO_FACES, mesh)
    large = TetMesh(1e4 * mesh.vertices + 3e3, mesh.tets)
    moved = embed_surface(1e4 * points + 3e3, NO_FACES, large)
    assert np.array_equal(moved.corners, surface.corners)
    assert moved.weights == pytest.approx(surface.weights, abs=1e-9)


def test_points_far_outside_follow_the_tets_where_that_is_allowed() -> None:
    mesh = box_mesh((3, 2, 2), (1.0, 0.7, 0.9))
    points = near(mesh, 80, seed=8, outside=0.5)
    with pytest.raises(ValueError, match="outside the tets"):
        embed_surface(points, NO_FACES, mesh)
    surface = embed_surface(points, NO_FACES, mesh, farthest=1.0)
    matrix, shift = affine(8)
    moved = surface.vertices(mesh.vertices @ matrix.T + shift)
    assert moved == pytest.approx(points @ matrix.T + shift, abs=1e-11)
    # within two edges of a tet, barycentric coordinates are of order two
    assert np.abs(surface.weights).max() < 4.0


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        ([[0, 0, np.inf]], NO_FACES, "vertex 0 is not finite"),
        ([[0, 0, 0]], [[0, 0, 1]], "face 0 has vertex index 1, but vertices has 1 rows"),
        ([[0, 0]], NO_FACES, r"vertices must have shape \(n, 3\)"),
        (np.zeros((0, 3)), NO_FACES, "the surface has no vertices"),
        (
            [[0.5, 0.5, 0.5], [0.5, 0.5, 1.1], [0.5, 0.5, 9.0]],
            NO_FACES,
            r"vertex 1 lies 0.1 outside the tets, 0.0577 of the mesh's diagonal and more than "
            r"0.02; 2 of 3 vertices affected: give the surface that the mesh fills",
        ),
    ],
)
def test_refuses_what_does_not_fit(vertices: ArrayLike, faces: ArrayLike, message: str) -> None:
    with pytest.raises(ValueError, match=f"embed_surface: .*{message}") as caught:
        embed_surface(vertices, faces, box_mesh())
    assert "\n" not in str(caught.value)
