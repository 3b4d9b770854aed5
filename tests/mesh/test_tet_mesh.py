"""TetMesh: measures, immutability, and refusals of invalid meshes."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

from snapspace.mesh import TetMesh

from .boxes import box_arrays, box_mesh

CORNER = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
ONE = np.array([[0, 1, 2, 3]])


def refuse(vertices: ArrayLike, tets: ArrayLike, message: str) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        TetMesh(vertices, tets)
    assert "\n" not in str(caught.value)


def test_a_corner_tet_has_a_sixth_of_the_cube() -> None:
    mesh = TetMesh(CORNER, ONE)
    assert mesh.volume == pytest.approx(1 / 6)
    assert mesh.vertex_masses == pytest.approx(np.full(4, 1 / 24))
    assert mesh.diagonal == pytest.approx(np.sqrt(3))
    assert len(mesh.surface) == 4


def test_a_box_has_its_volume_and_its_diagonal() -> None:
    mesh = box_mesh((3, 4, 2), (2.0, 3.0, 0.5))
    assert mesh.volume == pytest.approx(3.0)
    assert mesh.diagonal == pytest.approx(np.linalg.norm([2.0, 3.0, 0.5]))
    assert mesh.vertex_masses.sum() == pytest.approx(3.0)
    assert mesh.components.max() == 0


def test_vertex_masses_weigh_the_centroid() -> None:
    """A quarter of each tet's volume per corner integrates linear functions exactly."""
    mesh = box_mesh((3, 4, 2), (2.0, 3.0, 0.5))
    centroid = mesh.vertex_masses @ mesh.vertices / mesh.volume
    assert centroid == pytest.approx([1.0, 1.5, 0.25])


def test_arrays_have_the_types_of_the_conventions() -> None:
    vertices, tets = box_arrays()
    mesh = TetMesh(vertices.astype(np.float32), tets.astype(np.uint64).tolist())
    assert (mesh.vertices.dtype, mesh.tets.dtype) == (np.float64, np.int32)
    assert mesh.surface.dtype == mesh.surface_vertices.dtype == np.int32
    assert mesh.vertices.flags.c_contiguous and mesh.tets.flags.c_contiguous


def test_arrays_are_copied_and_read_only() -> None:
    vertices, tets = box_arrays()
    mesh = TetMesh(vertices, tets)
    vertices[:] = 0
    assert mesh.volume == pytest.approx(1.0)
    for array in (
        mesh.vertices, mesh.tets, mesh.volumes, mesh.vertex_masses, mesh.surface,
        mesh.surface_vertices, mesh.dihedral_angles, mesh.components,
    ):  # fmt: skip
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    with pytest.raises(AttributeError):
        mesh.vertices = vertices  # type: ignore[misc]


def test_pickling_gives_the_same_read_only_mesh() -> None:
    mesh = box_mesh()
    copy = pickle.loads(pickle.dumps(mesh))
    assert copy.fingerprint == mesh.fingerprint
    assert not copy.vertices.flags.writeable


def test_fingerprint_changes_with_every_array_and_nothing_else() -> None:
    vertices, tets = box_arrays()
    mesh = TetMesh(vertices, tets)
    assert TetMesh(vertices.copy(order="F"), tets.astype(np.int64)).fingerprint == mesh.fingerprint
    moved = vertices.copy()
    moved[0, 0] = np.nextafter(0.0, -1.0)
    assert TetMesh(moved, tets).fingerprint != mesh.fingerprint
    assert TetMesh(vertices, tets[::-1]).fingerprint != mesh.fingerprint
    assert len(mesh.fingerprint) == 64


def test_repr_is_one_line() -> None:
    assert repr(box_mesh()) == "TetMesh(27 vertices, 48 tets, volume 1, diagonal 1.73205)"


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1), st.floats(-6, 6), st.floats(0, 1e3))
def test_volume_scales_and_ignores_rigid_motions(seed: int, scale: float, offset: float) -> None:
    rng = np.random.default_rng(seed)
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    mesh = box_mesh()
    moved = TetMesh(10**scale * (mesh.vertices @ rotation.T + offset), mesh.tets)
    assert moved.volume == pytest.approx(10 ** (3 * scale), rel=1e-9)


def test_slivers_such_as_those_of_tetgen_are_accepted() -> None:
    sliver = [[0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0.5, 0.3, 1e-7]]
    assert TetMesh(sliver, ONE).volume == pytest.approx(1e-7 / 6)


@pytest.mark.parametrize(
    ("vertices", "tets", "message"),
    [
        (CORNER[:, :2], ONE, r"TetMesh: vertices must have shape \(n, 3\), got \(4, 2\)"),
        (CORNER.ravel(), ONE, r"vertices must have shape \(n, 3\), got \(12,\)"),
        ([[0, 0, 0], [1, 0]], ONE, "vertices is not a rectangular array of numbers"),
        (CORNER + 0j, ONE, "vertices must be real numbers, got dtype complex128"),
        ([["a", "b", "c"]], ONE, "vertices must be real numbers"),
        (CORNER, ONE[:, :3], r"tets must have shape \(m, 4\), got \(1, 3\)"),
        (CORNER, ONE.astype(float), "tets must be integers, got dtype float64"),
        (CORNER, ONE > 0, "tets must be integers, got dtype bool"),
        (CORNER, ONE + 2**40, "tets has an index that does not fit in 32 bits"),
        (CORNER, np.empty((0, 4), dtype=int), "there are no tets; at least one is needed"),
        (CORNER, [[0, 1, 2, 940]], "tet 0 has vertex index 940, but vertices has 4 rows$"),
        (CORNER, [[0, 1, 2, 3], [0, -1, 2, 3]], "tet 1 has vertex index -1, but vertices has 4"),
        (CORNER, ONE + 1, "tet 0 has vertex index 4.*seem to start at 1: subtract 1"),
    ],
)
def test_refuses_wrong_arrays(vertices: ArrayLike, tets: ArrayLike, message: str) -> None:
    refuse(vertices, tets, message)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_refuses_coordinates_that_are_not_finite(value: float) -> None:
    vertices, tets = box_arrays()
    vertices[7, 1] = vertices[9, 2] = value
    refuse(vertices, tets, r"vertex 7 is not finite \(0, .*; 2 vertices of 27 affected")


def test_refuses_coordinates_too_large_to_compute_with() -> None:
    refuse(CORNER * 1e200, ONE, r"coordinates up to 1e\+200 are too large")


def test_refuses_a_tet_that_repeats_a_vertex() -> None:
    vertices, tets = box_arrays()
    tets[5, 3] = tets[5, 0]
    refuse(vertices, tets, r"tet 5 repeats a vertex .*1 such tet of 48: drop with .*repair_tets")


def test_refuses_a_tet_that_occurs_twice() -> None:
    vertices, tets = box_arrays()
    twice = np.concatenate([tets, tets[[4, 2]][:, [1, 2, 0, 3]]])
    refuse(vertices, twice, r"tet 48 has the same four vertices .*2 such tets of 50: drop with")


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_refuses_zero_volume_at_every_scale(scale: float) -> None:
    flat = np.concatenate([CORNER, [[1, 1, 0]]]) * scale
    tets = [[0, 1, 2, 3], [0, 1, 2, 4]]
    refuse(flat, tets, r"tet 1 \(0, 1, 2, 4\) has zero volume; 1 such tet of 2: .*--repair")


@pytest.mark.parametrize(
    "move", [lambda x: x + 1e17, lambda x: x * [1, 1, 0], lambda x: x * 1e-300]
)
def test_where_every_tet_is_flat_the_cure_is_at_the_source(
    move: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> None:
    """Without flat tets there would be no mesh."""
    vertices, tets = box_arrays()
    refuse(move(vertices), tets, r"every tet \(48\) has zero volume: .* too far from the origin")


def test_refuses_inverted_tets() -> None:
    vertices, tets = box_arrays()
    tets[[3, 8]] = tets[[3, 8]][:, [1, 0, 2, 3]]
    refuse(vertices, tets, r"tet 3 .* is inverted \(volume -0\.02.*2 such tets of 48: flip with")


def test_says_when_all_tets_are_inverted() -> None:
    vertices, tets = box_arrays()
    refuse(
        vertices,
        tets[:, ::-1][:, [1, 0, 2, 3]][:, [1, 0, 3, 2]],
        r"every tet \(48\) is inverted .*flip with",
    )


def test_refuses_unused_vertices() -> None:
    vertices, tets = box_arrays()
    extra = np.concatenate([vertices, [[5, 5, 5], [6, 6, 6]]])
    refuse(extra, tets, "vertex 27 belongs to no tet; 2 such vertices of 29: drop with .*repair")


def test_refuses_several_components_and_gives_their_sizes() -> None:
    vertices, tets = box_arrays()
    both = np.concatenate([CORNER - 9, vertices])
    refuse(both, np.concatenate([ONE, tets + 4]), r"has 2 components \(48, 1 tets\), one is needed")


def test_tets_that_share_only_a_vertex_are_one_component() -> None:
    vertices = np.concatenate([CORNER, -CORNER[1:]])
    mesh = TetMesh(vertices, [[0, 1, 2, 3], [0, 5, 4, 6]])
    assert mesh.volume == pytest.approx(1 / 3)
