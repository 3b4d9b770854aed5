"""EmbeddedSurface: vertices as weighted corners of a mesh."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike

from snapspace.mesh import (
    EmbeddedSurface,
    boundary_surface,
    compact_surface,
    embed_surface,
    vertex_normals,
)

from .boxes import box_mesh, irregular_mesh

FACE = [[0, 1, 2]]
CORNERS = [[0, 1, 2, 3], [4, 4, 4, 4], [0, 2, 4, 1]]
WEIGHTS = [[0.25, 0.25, 0.25, 0.25], [1.0, 0.0, 0.0, 0.0], [0.0, 1.5, -0.5, 0.0]]


def test_vertices_are_the_weighted_corners() -> None:
    x = np.random.default_rng(0).normal(size=(5, 3))
    surface = EmbeddedSurface(FACE, CORNERS, WEIGHTS)
    expected = np.stack([x[:4].mean(axis=0), x[4], 1.5 * x[2] - 0.5 * x[4]])
    assert surface.vertices(x) == pytest.approx(expected)
    assert np.array_equal(surface.vertices(x.reshape(-1)), surface.vertices(x))
    assert not surface.exact


def test_a_single_weight_copies_without_rounding() -> None:
    x = np.random.default_rng(1).normal(size=(5, 3)) * 1e17
    assert np.array_equal(EmbeddedSurface(FACE, CORNERS, WEIGHTS).vertices(x)[1], x[4])


def test_matrix_is_the_same_map_without_stored_zeros() -> None:
    x = np.random.default_rng(2).normal(size=(7, 3))
    surface = EmbeddedSurface(FACE, CORNERS, WEIGHTS)
    matrix = surface.matrix(7)
    assert matrix.shape == (3, 7)
    assert matrix.nnz == 4 + 1 + 2 and (matrix.data != 0).all()
    assert np.array_equal(matrix @ x, surface.vertices(x))
    assert matrix.sum(axis=1) == pytest.approx(1.0)


def test_matrix_adds_a_corner_that_is_named_twice() -> None:
    surface = EmbeddedSurface([[0, 0, 0]], [[3, 3, 1, 1]], [[0.5, 0.5, 0.5, -0.5]])
    matrix = surface.matrix(4)
    assert (matrix.indices.tolist(), matrix.data.tolist()) == ([3], [1.0])


@pytest.mark.parametrize("place", range(4))
def test_exact_means_single_weights_in_any_place(place: int) -> None:
    weights = np.roll([[1.0, 0.0, 0.0, 0.0]], place, axis=1)
    surface = EmbeddedSurface([[0, 0, 0]], [[3, 1, 2, 0]], weights)
    x = np.random.default_rng(3).normal(size=(4, 3))
    assert surface.exact
    assert np.array_equal(surface.vertices(x)[0], x[[3, 1, 2, 0][place]])


def test_the_boundary_follows_every_deformation_exactly() -> None:
    mesh = irregular_mesh()
    surface = boundary_surface(mesh)
    assert surface.exact
    x = np.random.default_rng(4).normal(size=mesh.vertices.shape)
    vertices, faces = compact_surface(x, mesh.surface)
    assert np.array_equal(surface.vertices(x), vertices)
    assert np.array_equal(surface.faces, faces)
    assert np.array_equal(surface.vertices(x)[surface.faces], x[mesh.surface])


def test_the_boundary_does_not_depend_on_inner_vertices() -> None:
    mesh = box_mesh((3, 3, 3))
    inside = np.setdiff1d(np.arange(len(mesh.vertices)), mesh.surface_vertices)
    x = mesh.vertices.copy()
    x[inside] = np.nan
    surface = boundary_surface(mesh)
    assert len(inside) and len(surface.corners) == len(mesh.surface_vertices)
    assert np.isfinite(surface.vertices(x)).all()
    normals = vertex_normals(surface.vertices(mesh.vertices), surface.faces)
    assert ((surface.vertices(mesh.vertices) - 0.5) * normals).sum(axis=1).min() > 0


def test_the_result_is_fresh_and_the_surface_is_frozen() -> None:
    mesh = box_mesh()
    surface = boundary_surface(mesh)
    surface.vertices(mesh.vertices)[:] = 7.0
    assert surface.vertices(mesh.vertices).max() == 1.0
    corners = np.array(CORNERS)
    own = EmbeddedSurface(FACE, corners, WEIGHTS)
    corners[:] = 0
    assert own.corners.tolist() == CORNERS
    for array in (own.faces, own.corners, own.weights):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@pytest.mark.parametrize(
    ("faces", "corners", "weights", "message"),
    [
        ([[0, 1, 3]], CORNERS, WEIGHTS, "face 0 has vertex index 3, but vertices has 3 rows"),
        ([[0.0, 1, 2]], CORNERS, WEIGHTS, "faces must be integers"),
        (FACE, [[0, 1, 2]], WEIGHTS, r"corners must have shape \(m, 4\)"),
        (FACE, CORNERS, WEIGHTS[:2], r"weights must have the shape of corners, \(3, 4\), got"),
        (FACE, [[0, 1, 2, -3], *CORNERS[1:]], WEIGHTS, "vertex 0 has the negative corner -3"),
        (
            FACE,
            CORNERS,
            [*WEIGHTS[:2], [1, 1, 0, 0]],
            "weights of vertex 2 sum to 2, not to one",
        ),
        (FACE, CORNERS, [[np.nan] * 4, *WEIGHTS[1:]], "weights of vertex 0 sum to nan"),
        (FACE, CORNERS, [[np.inf, -1, 0, 0], *WEIGHTS[1:]], "weights of vertex 0 sum to inf"),
    ],
)
def test_refuses_arrays_that_are_not_an_embedding(
    faces: ArrayLike, corners: ArrayLike, weights: ArrayLike, message: str
) -> None:
    with pytest.raises(ValueError, match=f"EmbeddedSurface: .*{message}") as caught:
        EmbeddedSurface(faces, corners, weights)  # type: ignore[arg-type]
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        (np.zeros((4, 3)), "the shape has 4 vertices, but the surface follows tet vertex 4"),
        (np.zeros(14), r"a shape must be \(n, 3\) or \(3n,\), got \(14,\)"),
        (np.zeros((5, 4)), r"got \(5, 4\)"),
    ],
)
def test_refuses_shapes_of_another_mesh(shape: np.ndarray, message: str) -> None:
    surface = EmbeddedSurface(FACE, CORNERS, WEIGHTS)
    with pytest.raises(ValueError, match=message):
        surface.vertices(shape)
    with pytest.raises(ValueError, match="has 4 vertices"):
        surface.matrix(4)


def test_the_nearest_corner_is_that_of_the_largest_weight() -> None:
    assert EmbeddedSurface(FACE, CORNERS, WEIGHTS).nearest.tolist() == [0, 4, 2]
    mesh = irregular_mesh()
    assert np.array_equal(boundary_surface(mesh).nearest, mesh.surface_vertices)


def test_only_the_boundary_is_the_boundary() -> None:
    mesh = irregular_mesh()
    own = boundary_surface(mesh)
    assert own.is_boundary(mesh)
    assert EmbeddedSurface(own.faces, own.corners, own.weights).is_boundary(mesh)
    assert not own.is_boundary(box_mesh())
    assert not EmbeddedSurface(own.faces[::-1], own.corners, own.weights).is_boundary(mesh)
    assert not embed_surface(own.vertices(mesh.vertices) * 0.99, own.faces, mesh).is_boundary(mesh)
