"""open_surface: files come back with new positions, and nothing else in them changes."""

from __future__ import annotations

import json
import re
import warnings
from codecs import BOM_UTF8
from pathlib import Path

import numpy as np
import pytest
import trimesh

from snapspace import SurfaceFile, open_surface, read_surface
from snapspace.mesh.surface_file.content import layout_of

from .surface_files import KINDS, QUADS, write_file

LINEAR = np.array([[0.0, -1.5, 0.0], [0.75, 0.25, 0.0], [0.0, 0.5, 2.0]])
TURN = np.array([[0.6, -0.8, 0.0], [0.0, 0.0, -1.0], [0.8, 0.6, 0.0]])
MOVE = np.array([0.25, -3.0, 0.5])
NUMBERS = re.compile(rb"[-+0-9.e]+")


@pytest.mark.parametrize("kind", KINDS)
def test_without_motion_every_byte_stays(tmp_path: Path, kind: str) -> None:
    file = write_file(tmp_path, kind)
    surface = open_surface(file)
    noise = 1.0 + 1e-15 * np.random.default_rng(0).normal(size=surface.vertices.shape)
    assert surface.with_vertices(surface.vertices * noise) == surface.data
    if kind != "gltf":  # its other files are inside now
        assert surface.data == file.read_bytes()


@pytest.mark.parametrize("kind", KINDS)
def test_vertices_and_faces_are_those_of_read_surface(tmp_path: Path, kind: str) -> None:
    file = write_file(tmp_path, kind)
    surface = open_surface(file)
    vertices, faces = read_surface(file)
    assert np.array_equal(surface.vertices, vertices)
    assert np.array_equal(surface.faces, faces)
    if kind.startswith(("obj", "off", "ply")):
        assert surface.corners.reshape(-1, 4).tolist() == QUADS
        assert surface.starts.tolist() == list(range(0, 25, 4))
    else:
        assert surface.starts.tolist() == list(range(0, 37, 3))


@pytest.mark.parametrize("kind", ["obj", "off", "ply ascii", "ply binary_little_endian"])
def test_texts_may_begin_with_a_byte_order_mark(tmp_path: Path, kind: str) -> None:
    """Editors on Windows write one."""
    file = write_file(tmp_path, kind)
    before = open_surface(file)
    content = file.read_bytes()
    if kind == "obj":  # a mark before a comment does no harm
        content = content[content.index(b"v  ") :]
    file.write_bytes(BOM_UTF8 + content)
    surface = open_surface(file)
    assert np.array_equal(surface.vertices, before.vertices)
    assert np.array_equal(surface.faces, before.faces)
    assert np.array_equal(read_surface(file)[0], before.vertices)
    assert surface.with_vertices(before.vertices) == content


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "obj relative"])
def test_an_independent_reader_finds_the_moved_shape(tmp_path: Path, kind: str) -> None:
    """trimesh sees the motion, the same colours and UVs, and the same faces."""
    file = write_file(tmp_path, kind)
    surface = open_surface(file)
    assert len(surface.compact().vertices) == 8  # the seams of STL and glTF are one vertex
    moved = tmp_path / f"moved{file.suffix}"
    surface.write(moved, surface.vertices @ LINEAR.T + MOVE)
    before, after = (_meshes(path) for path in (file, moved))
    for old, new in zip(before, after, strict=True):
        np.testing.assert_allclose(new.vertices, old.vertices @ LINEAR.T + MOVE, atol=2e-6)
        assert np.array_equal(new.faces, old.faces)
        assert type(new.visual) is type(old.visual)
        uv, old_uv = (getattr(mesh.visual, "uv", None) for mesh in (new, old))
        assert (uv is None) == (old_uv is None) and (uv is None or np.array_equal(uv, old_uv))


def _meshes(path: Path) -> list[trimesh.Trimesh]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # trimesh warns of the vertex without faces
        return trimesh.load_scene(path, process=False, maintain_order=True).dump()


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "off"])
def test_normals_and_tangents_follow_an_affine_motion(tmp_path: Path, kind: str) -> None:
    """A normal is a linear form: it maps with the inverse transpose; a tangent is a vector.

    The normals of PLY are means over several faces, which only rotations map like that.
    """
    linear = 1.5 * TURN if kind.startswith("ply") else LINEAR
    surface = open_surface(write_file(tmp_path, kind))
    before = layout_of(surface.suffix, surface.data)
    after = layout_of(surface.suffix, surface.with_vertices(surface.vertices @ linear.T + MOVE))
    assert len(before.directions) == (2 if kind in ("glb", "gltf") else 1)
    for old, new in zip(before.directions, after.directions, strict=True):
        turn = np.eye(3)
        if before.to_world is not None:  # all nodes of the file are turned alike
            turn = before.to_world[0, :, :3]
        world, found = (one.slots.values @ turn.T for one in (old, new))
        expected = world @ (linear.T if old.kind == "tangent" else np.linalg.inv(linear))
        expected /= np.linalg.norm(expected, axis=1, keepdims=True)
        np.testing.assert_allclose(found, expected, atol=2e-6)


def test_a_mirrored_node_turns_faces_round(tmp_path: Path) -> None:
    """Blender writes negative scales as they are; the part was inside out (glTF 2.0, 3.7.4)."""
    file = write_file(tmp_path, "gltf")
    plain = open_surface(file)
    document = json.loads(file.read_text(encoding="utf-8"))
    document["nodes"][0]["scale"] = [1, -1, 1]
    file.write_text(json.dumps(document), encoding="utf-8")
    mirrored = open_surface(file)
    assert [_volume(one) for one in (plain, mirrored)] == pytest.approx([1.0, 1.0])
    uv = [
        dict(zip(one.corners.tolist(), one.appearance.texture_coordinates.tolist(), strict=True))
        for one in (plain, mirrored)
    ]
    assert uv[0] == uv[1], "they stay at their points"


def _volume(surface: SurfaceFile) -> float:
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    return float((np.cross(a, b) * c).sum() / 6.0)


@pytest.mark.parametrize("kind", ["obj relative", "off", "ply ascii", "stl ascii"])
def test_in_texts_only_numbers_of_positions_and_normals_change(tmp_path: Path, kind: str) -> None:
    file = write_file(tmp_path, kind)
    surface = open_surface(file)
    after = surface.with_vertices(surface.vertices @ LINEAR.T + MOVE)
    old, new = file.read_bytes().split(b"\n"), after.split(b"\n")
    changed = [a for a, b in zip(old, new, strict=True) if a != b]
    assert [NUMBERS.sub(b"", a) for a in old] == [NUMBERS.sub(b"", b) for b in new]
    lines = {"obj relative": 9 + 6, "off": 8, "ply ascii": 8, "stl ascii": 12 + 36}
    assert len(changed) == lines[kind]


def test_one_moved_vertex_changes_one_line(tmp_path: Path) -> None:
    surface = open_surface(write_file(tmp_path, "off"))
    vertices = surface.vertices.copy()
    vertices[3, 1] = 1.0 / 3.0
    old, new = surface.data.split(b"\n"), surface.with_vertices(vertices).split(b"\n")
    (line,) = [k for k in range(len(old)) if old[k] != new[k]]
    assert new[line] == b"0.0  0.3333333333333333 1.0 255 0 3 255"


def test_unused_vertices_stay_where_they_are(tmp_path: Path) -> None:
    surface = open_surface(write_file(tmp_path, "obj")).compact()
    assert b"\r\nv 7 7 7\r\n" in surface.with_vertices(surface.vertices + 1.0)
    assert surface.corners.tolist() == [corner for quad in QUADS for corner in quad]


def test_materials_are_named(tmp_path: Path) -> None:
    assert open_surface(write_file(tmp_path, "obj")).refers_to == ("cube.mtl",)
    assert open_surface(write_file(tmp_path, "ply ascii")).refers_to == ("skin.png",)


@pytest.mark.parametrize("kind", KINDS)
def test_a_surface_without_area_keeps_its_normals(tmp_path: Path, kind: str) -> None:
    """Collapsed faces have no direction of their own; nothing becomes nan."""
    file = write_file(tmp_path, kind)
    surface = open_surface(file)
    surface.write(file, 0.0 * surface.vertices)
    assert b"nan" not in file.read_bytes().lower()
    assert np.abs(read_surface(file)[0]).max() < 1e-6


def test_mistakes_are_named(tmp_path: Path) -> None:
    file = write_file(tmp_path, "obj")
    surface = open_surface(file)
    with pytest.raises(ValueError, match="has 9 vertices, but 8 are given"):
        surface.write(tmp_path / "a.obj", surface.vertices[1:])
    with pytest.raises(ValueError, match="vertex 0 is not finite"):
        surface.write(tmp_path / "a.obj", surface.vertices * np.nan)
    with pytest.raises(ValueError, match=r"a\.ply: unknown extension '\.ply'; known are \.obj"):
        surface.write(tmp_path / "a.ply", surface.vertices)
    with pytest.raises(ValueError, match=r"unknown extension '\.x'; known are \.obj"):
        SurfaceFile("a.x", b"")
    assert not (tmp_path / "a.obj").exists()


def test_whole_number_coordinates_are_refused_when_written(tmp_path: Path) -> None:
    header = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
    header += b"property int x\nproperty int y\nproperty int z\nelement face 1\n"
    header += b"property list uchar uchar vertex_indices\nend_header\n"
    rows = np.arange(9, dtype="<i4").tobytes() + bytes([3, 0, 1, 2])
    (tmp_path / "a.ply").write_bytes(header + rows)
    surface = open_surface(tmp_path / "a.ply")
    assert surface.vertices.tolist() == np.arange(9).reshape(3, 3).tolist()
    with pytest.raises(ValueError, match=r"b\.ply: its coordinates are whole numbers"):
        surface.write(tmp_path / "b.ply", surface.vertices + 0.5)


@pytest.mark.parametrize(
    ("name", "up"),
    [("A.OBJ", "y"), ("a.glb", "y"), ("a.gltf", "y"), ("a.stl", "z"), ("a.ply", "z")],
)
def test_an_axis_is_usually_up_in_a_format(name: str, up: str) -> None:
    assert SurfaceFile(name, b"").up == up
