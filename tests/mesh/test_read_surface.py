"""read_surface: OBJ, OFF, PLY and STL files, and their faults."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace.mesh import read_surface

OBJ = """# comment
mtllib nothing.mtl
o first
v 0 0 0 1.0
v 1 0 0
v 1 1 0
v 0 1 0
v 9 9 9
vt 0 0
vn 0 0 1
usemtl none
f 1 2 3 4
f 1/1 2/1 3/1
f -5//1 -4//1 \\
 -3//1
v 0 0 1
f 1/1/1 2/1/1 -1/1/1
l 1 2
"""
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]], dtype=float)


def test_obj_with_textures_normals_polygons_and_relative_indices(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(OBJ)
    vertices, faces = read_surface(tmp_path / "a.obj")
    assert vertices.tolist() == [*SQUARE[:4].tolist(), [9, 9, 9], [0, 0, 1]]
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 1, 2], [0, 1, 5]]
    assert (vertices.dtype, faces.dtype) == (np.float64, np.int32)


def test_polygons_become_fans_in_order(tmp_path: Path) -> None:
    (tmp_path / "a.off").write_text(
        "OFF # comment\n\n6 2 0\n" + "0 0 0\n" * 6 + "5 0 1 2 3 4\n3 3 4 5 255 0 0\n"
    )
    _, faces = read_surface(tmp_path / "a.off")
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4], [3, 4, 5]]


def test_off_may_have_its_counts_and_colours_on_the_lines(tmp_path: Path) -> None:
    (tmp_path / "a.off").write_text(
        "COFF 3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n"
    )
    vertices, faces = read_surface(tmp_path / "a.off")
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert faces.tolist() == [[0, 1, 2]]


PLY_HEADER = """ply
format {} 1.0
comment other elements and further properties are skipped
element marker 1
property ushort id
element vertex 5
property uchar red
property float x
property double y
property float z
element face 2
property list uchar int {}
property float quality
element edge 0
property int vertex1
end_header
"""


def ply_rows(order: str) -> bytes:
    rows = np.array([7], order + "u2").tobytes()
    vertex = np.dtype(
        [("red", "u1"), ("x", order + "f4"), ("y", order + "f8"), ("z", order + "f4")]
    )
    rows += np.array([(9, *point) for point in SQUARE], dtype=vertex).tobytes()
    for corners in ([0, 1, 2, 3], [0, 1, 4]):
        rows += bytes([len(corners)]) + np.array(corners, order + "i4").tobytes()
        rows += np.array([0.5], order + "f4").tobytes()
    return rows


@pytest.mark.parametrize("name", ["vertex_indices", "vertex_index"])
@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply_of_every_encoding(tmp_path: Path, encoding: str, name: str) -> None:
    if encoding == "ascii":
        rows = "7\n" + "".join(f"9 {x} {y} {z}\n" for x, y, z in SQUARE.tolist())
        body = (rows + "4 0 1 2 3 0.5\n3 0 1 4 0.5\n").encode()
    else:
        body = ply_rows("<" if "little" in encoding else ">")
    (tmp_path / "a.ply").write_bytes(PLY_HEADER.format(encoding, name).encode() + body)
    vertices, faces = read_surface(tmp_path / "a.ply")
    assert np.array_equal(vertices, SQUARE)
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 4]]


def test_ply_with_equal_faces_is_read_quickly_to_the_same_result(tmp_path: Path) -> None:
    header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    header += "property float z\nelement face {}\nproperty list uchar int vertex_indices\n"
    header += "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    (tmp_path / "equal.ply").write_text(header.format(2) + "3 0 1 2\n3 1 2 3\n")
    (tmp_path / "mixed.ply").write_text(header.format(3) + "3 0 1 2\n3 1 2 3\n4 0 1 2 3\n")
    _, equal = read_surface(tmp_path / "equal.ply")
    _, mixed = read_surface(tmp_path / "mixed.ply")
    assert equal.tolist() == mixed[:2].tolist() == [[0, 1, 2], [1, 2, 3]]


def test_stl_points_are_merged_in_their_order(tmp_path: Path) -> None:
    triangles = SQUARE[[[1, 2, 0], [0, 2, 3]]]
    text = "solid a\n"
    for triangle in triangles:
        text += "facet normal 0 0 1\nouter loop\n"
        text += "".join("vertex {} {} {}\n".format(*point) for point in triangle)
        text += "endloop\nendfacet\n"
    (tmp_path / "a.stl").write_text(text + "endsolid\n")
    vertices, faces = read_surface(tmp_path / "a.stl")
    assert vertices.tolist() == SQUARE[[1, 2, 0, 3]].tolist()
    assert np.array_equal(vertices[faces], triangles)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.obj", "v 0 0 0\n", r"it has no faces \(1 vertices\)"),
        ("a.obj", "v 0 0\n", "line 1: a vertex needs three coordinates"),
        ("a.obj", "v 0 0 x\n", "a coordinate that is not a number"),
        ("a.obj", "v 0 0 0\nf 1 1 x\n", "line 2: 'x' is not a corner of a face"),
        ("a.obj", "v 0 0 0\nf 0 1 1\n", "vertex index 0, but OBJ counts from 1"),
        ("a.obj", "v 0 0 0\nf 1 1 9\n", "line 2: a face has vertex index 9, but the file has 1 "),
        ("a.obj", "v 0 0 0\nf 1 1 -4\n", "line 2: a face has vertex index -4"),
        ("a.obj", "v 0 0 0\nf 1 1\n", "face 0 has 2 corners; at least 3 are needed"),
        ("a.obj", "v 0 nan 0\nf 1 1 1\n", "vertex 0 is not finite"),
        ("a.off", "OFX\n", "does not begin with OFF"),
        ("a.off", "OFF\n3\n", "numbers of vertices and faces are missing"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n", "3 vertices and 1 faces are announced, but the file"),
        ("a.off", "OFF\n1 1 0\n0 0\n3 0 0 0\n", "do not all have the same number of coordinates"),
        ("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 x\n", "face 0 is not a list of indices"),
        ("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n", "face 0 announces 3 corners, but has 2"),
        ("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 7\n", "face 0 has vertex index 7"),
        ("a.ply", "plx\n", "header from ply to end_header"),
        ("a.ply", "ply\nformat odd 1.0\nend_header\n", "its format is 'odd'; known are ascii"),
        ("a.ply", "ply\nformat ascii 1.0\nend_header\n", "it has no vertices"),
        ("a.ply", PLY_HEADER.format("ascii", "vertex_index") + "7\n9 0 0 0\n", "it is incomplete"),
        ("a.ply", PLY_HEADER.format("ascii", "corners") + "7" + " 0" * 20 + " 3 0 0 0 0" * 2,
         "its faces have no vertex_indices"),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex x\nend_header\n", "an element is 'x'"),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n",
         "the type 'quad' is not known"),
        ("a.stl", "nothing", "it is not an STL file, or it is incomplete"),
        ("a.txt", "", r"unknown extension '\.txt'; known are \.obj, \.off, \.ply, \.stl"),
    ],
)  # fmt: skip
def test_planted_faults(tmp_path: Path, name: str, text: str, message: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=message) as caught:
        read_surface(tmp_path / name)
    assert str(caught.value).startswith(str(tmp_path / name))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["a.obj", "a.off", "a.ply", "a.stl"])
@pytest.mark.parametrize("junk", [b"", b"hello world\n", bytes(range(256)) * 20])
def test_junk_gives_one_clear_line(tmp_path: Path, name: str, junk: bytes) -> None:
    (tmp_path / name).write_bytes(junk)
    with pytest.raises(ValueError, match=r"^[^\n]*" + name + r": [^\n]*$"):
        read_surface(tmp_path / name)
