"""Boundary faces, normals and dihedral angles of tet meshes."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.mesh import TetMesh, boundary_faces, compact_surface, vertex_normals

from .boxes import box_mesh

# Too many vertices to pack the three indices of a face into 64 bits.
MANY = 3_000_000


def enclosed_volume(vertices: np.ndarray, faces: np.ndarray) -> float:
    """Divergence theorem: positive only if the faces are closed and outward."""
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def test_surface_of_a_box_is_closed_outward_and_complete() -> None:
    mesh = box_mesh((3, 4, 2), (2.0, 3.0, 0.5))
    assert len(mesh.surface) == 4 * (3 * 4 + 4 * 2 + 3 * 2)
    assert enclosed_volume(mesh.vertices, mesh.surface) == pytest.approx(mesh.volume)
    edges = {(f[i], f[(i + 1) % 3]) for f in mesh.surface.tolist() for i in range(3)}
    assert len(edges) == 3 * len(mesh.surface)
    assert edges == {(b, a) for a, b in edges}


def test_surface_vertices_are_those_on_the_sides() -> None:
    mesh = box_mesh((3, 3, 3))
    inside = ((mesh.vertices > 0.01) & (mesh.vertices < 0.99)).all(axis=1)
    assert mesh.surface_vertices.tolist() == np.flatnonzero(~inside).tolist()


def test_surface_does_not_depend_on_the_order_of_corners() -> None:
    mesh = box_mesh()
    even = boundary_faces(np.ascontiguousarray(mesh.tets[:, [1, 2, 0, 3]]))
    canonical = [{tuple(np.roll(f, -f.argmin()).tolist()) for f in g} for g in (mesh.surface, even)]
    assert canonical[0] == canonical[1]


def test_normals_of_a_box_point_outward() -> None:
    mesh = box_mesh((4, 4, 4))
    normals = vertex_normals(mesh.vertices, mesh.surface)
    top = np.flatnonzero(
        (mesh.vertices[:, 2] == 1) & (np.abs(mesh.vertices[:, :2] - 0.5) < 0.4).all(axis=1)
    )
    assert normals[top] == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(top), 1)))
    lengths = np.linalg.norm(normals, axis=1)
    assert lengths[mesh.surface_vertices] == pytest.approx(1.0)
    inside = np.setdiff1d(np.arange(len(mesh.vertices)), mesh.surface_vertices)
    assert len(inside) and not lengths[inside].any()


def test_normals_are_weighted_by_area() -> None:
    """Splitting a side into more triangles without changing the areas leaves the normal alone."""
    vertices = np.array([[0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0.5, 0]], dtype=float)
    whole = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    split = np.array([[0, 1, 4], [0, 4, 2], [0, 2, 3]], dtype=np.int32)
    assert vertex_normals(vertices, split)[0] == pytest.approx(vertex_normals(vertices, whole)[0])
    assert vertex_normals(vertices, whole)[0] == pytest.approx(np.array([1, 0, 2]) / np.sqrt(5))


def test_compact_surface_keeps_the_triangles_and_the_order() -> None:
    mesh = box_mesh((3, 3, 3))
    vertices, faces = compact_surface(mesh.vertices, mesh.surface)
    assert np.array_equal(vertices, mesh.vertices[mesh.surface_vertices])
    assert np.array_equal(vertices[faces], mesh.vertices[mesh.surface])
    assert faces.dtype == np.int32


def test_regular_tet_has_equal_dihedral_angles() -> None:
    vertices = [[1, 1, 1], [-1, 1, -1], [1, -1, -1], [-1, -1, 1]]
    angles = TetMesh(vertices, [[0, 1, 2, 3]]).dihedral_angles
    assert angles == pytest.approx(np.full((1, 6), np.degrees(np.arccos(1 / 3))))


def test_corner_tet_has_three_right_angles_at_its_axes() -> None:
    mesh = TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    oblique = np.degrees(np.arccos(1 / np.sqrt(3)))
    assert mesh.dihedral_angles[0] == pytest.approx([90, 90, 90, oblique, oblique, oblique])


def test_tiny_dihedral_angles_keep_their_digits() -> None:
    height = 1e-6
    mesh = TetMesh([[0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0.5, 0.5, height]], [[0, 1, 2, 3]])
    assert mesh.dihedral_angles[0, 0] == pytest.approx(np.degrees(height / 0.5), rel=1e-9)


def test_faces_do_not_depend_on_how_many_vertices_there_are() -> None:
    """Tets with the last indices of so many vertices that faces are sorted differently."""
    tets = box_mesh((5, 4, 3)).tets
    far = (MANY - 1 - tets.max() + tets).astype(np.int32)
    assert np.array_equal(boundary_faces(far), boundary_faces(tets) + far.min() - tets.min())
