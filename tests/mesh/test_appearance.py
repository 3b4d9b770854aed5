"""SurfaceFile.appearance: what a file says about texture coordinates, colours and materials."""

from __future__ import annotations

import json
import struct
from codecs import BOM_UTF8
from pathlib import Path

import numpy as np
import pytest
import trimesh

from snapspace.mesh import Appearance, SurfaceFile, open_surface
from snapspace.mesh.surface_file.mtl import picture_name

from .surface_files import CUBE, QUADS, gltf, obj, off, ply, stl

PNG = b"\x89PNG\r\n\x1a\n and the rest"
MTL = b"""# materials
newmtl red
Kd 1 0.5 0
map_Kd -s 1 1 1 -clamp on my skin.png
newmtl blue
Kd 0 0 1
map_Kd spots.tga
newmtl black
Kd 0 0 0
map_Kd my skin.png
"""


def look_of(file: SurfaceFile) -> Appearance:
    look = file.appearance
    assert look is not None
    return look


@pytest.mark.parametrize("variant", ["", "relative"])
def test_an_obj_has_coordinates_colours_normals_and_materials(variant: str) -> None:
    beside = {"cube.mtl": MTL, "my skin.png": PNG, "spots.tga": b"no picture for browsers"}
    file = SurfaceFile("cube.obj", obj(variant), beside=beside)
    look = look_of(file)
    assert look.texture_coordinates is not None and look.normals is not None
    # each side has the four corners of the texture; OBJ counts upwards, we count downwards
    corners = [[0, 1], [1, 1], [1, 0], [0, 0]]
    assert look.texture_coordinates.reshape(6, 4, 2).tolist() == [corners] * 6
    assert look.normals.reshape(6, 4).tolist() == [[side] * 4 for side in range(6)]
    assert look.colors is not None and (look.colors == [128, 64, 255]).all()
    names = [look.materials[number].name for number in look.material_of_polygon]
    assert names == ["red"] * 3 + ["blue"] * 3
    blue, red = look.materials
    assert red.texture == 0 and look.textures == (PNG,)
    assert red.color == pytest.approx((1.0, 0.2140411, 0.0)), "Kd is sRGB"
    assert blue.texture is None and blue.color == (0.0, 0.0, 1.0)
    assert look.missing == ("spots.tga",)


def test_a_library_of_materials_may_begin_with_a_byte_order_mark() -> None:
    """Editors on Windows write one."""
    library = b"newmtl blue\nKd 0 0 1\nnewmtl red\nKd 1 0 0\n"
    look = look_of(SurfaceFile("cube.obj", obj(""), beside={"cube.mtl": BOM_UTF8 + library}))
    assert [one.color for one in look.materials] == [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)]


def test_missing_materials_are_white_and_reported() -> None:
    look = look_of(SurfaceFile("cube.obj", obj("")))
    assert {one.color for one in look.materials} == {(1.0, 1.0, 1.0)}
    assert look.missing == ("cube.mtl",)


def test_a_texture_is_not_multiplied_by_black() -> None:
    data = obj("").replace(b"usemtl red", b"usemtl black")
    file = SurfaceFile("cube.obj", data, beside={"cube.mtl": MTL, "my skin.png": PNG})
    black = next(one for one in look_of(file).materials if one.name == "black")
    assert (black.texture, black.color) == (0, (1.0, 1.0, 1.0))


@pytest.mark.parametrize(
    ("values", "name"),
    [
        ("skin.png", "skin.png"),
        ("  my skin.png ", "my skin.png"),
        ("-s 1 2 -o 0.5 textures/skin.png", "textures/skin.png"),
        ("-blendu off -mm 0 1 -bm 2 a b.png", "a b.png"),
        ("-s 1 2 3", ""),
        ("", ""),
    ],
)
def test_options_of_a_map_are_skipped(values: str, name: str) -> None:
    assert picture_name(values) == name


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_a_ply_has_colours_and_coordinates_of_its_vertices(encoding: str) -> None:
    header = ply(encoding).replace(b"property uchar red\n", b"property uchar blue\n")
    assert look_of(SurfaceFile("cube.ply", header)).colors is None, "one of three is no colour"
    coordinates = np.linspace(0, 1, 16).reshape(8, 2)
    colors = np.arange(24).reshape(8, 3)
    data = painted_ply(encoding, colors, coordinates)
    look = look_of(SurfaceFile("cube.ply", data, beside={"skin.png": PNG}))
    vertices = np.ravel(QUADS)
    assert look.colors is not None and (look.colors == colors[vertices]).all()
    assert look.texture_coordinates is not None
    flipped = np.stack([coordinates[:, 0], 1 - coordinates[:, 1]], 1)
    assert look.texture_coordinates == pytest.approx(flipped[vertices], abs=1e-6)
    assert look.materials[0].texture == 0 and look.textures == (PNG,)


def painted_ply(encoding: str, colors: np.ndarray, coordinates: np.ndarray) -> bytes:
    names = "".join(f"property float {name}\n" for name in "xyzst")
    names += "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    body = b""
    order = ">" if "big" in encoding else "<"
    for place, at, color in zip(CUBE, coordinates.tolist(), colors.tolist(), strict=True):
        row = (*place.tolist(), *at, *color)
        text = (" ".join(map(str, row)) + "\n").encode()
        body += text if encoding == "ascii" else struct.pack(f"{order}5f3B", *row)
    for quad in QUADS:
        text = ("4 " + " ".join(map(str, quad)) + "\n").encode()
        body += text if encoding == "ascii" else struct.pack(f"{order}B4i", 4, *quad)
    return (
        f"ply\nformat {encoding} 1.0\ncomment TextureFile skin.png\nelement vertex 8\n{names}"
        f"element face 6\nproperty list uchar int vertex_indices\nend_header\n"
    ).encode() + body


@pytest.mark.parametrize("kind", ["glb", "gltf"])
def test_a_gltf_looks_as_another_reader_finds(tmp_path: Path, kind: str) -> None:
    path = gltf(tmp_path, kind=kind)
    file = open_surface(path)
    look = look_of(file)
    scene = trimesh.load(path, process=False)
    parts = list(scene.geometry.values())
    # it turns coordinates round so that they count upwards
    expected = np.concatenate([part.visual.uv[part.faces].reshape(-1, 2) for part in parts])
    expected[:, 1] = 1 - expected[:, 1]
    assert look.texture_coordinates == pytest.approx(expected, abs=1e-6)
    assert len(look.textures) == 1 and look.textures[0].startswith(b"\x89PNG")
    assert [(one.name, one.texture, one.roughness) for one in look.materials] == [("skin", 0, 1.0)]
    assert look.normals is not None and look.missing == ()
    # a vertex of a cube has three normals
    pairs = np.unique(np.stack([file.corners, look.normals], 1), axis=0)
    assert (np.bincount(pairs[:, 0]) == 3).all()


def changed_gltf(folder: Path, **material: object) -> SurfaceFile:
    path = gltf(folder, kind="gltf")
    content = json.loads(path.read_text(encoding="utf-8"))
    content["materials"] = [material]
    path.write_text(json.dumps(content), encoding="utf-8")
    return open_surface(path)


def test_a_gltf_may_move_its_texture(tmp_path: Path) -> None:
    moved = {"offset": [0.5, 0.25], "rotation": np.pi / 2, "scale": [2, 1]}
    link = {"index": 0, "extensions": {"KHR_texture_transform": moved}}
    file = changed_gltf(tmp_path, pbrMetallicRoughness={"baseColorTexture": link})
    found = look_of(file).texture_coordinates
    assert found is not None
    # counter-clockwise for the eye, with v downwards: (u, v) to (v, -u) after the scale
    corners = {(0.5, 0.25), (0.5, -1.75), (1.5, -1.75), (1.5, 0.25)}
    assert {(round(u, 5), round(v, 5)) for u, v in found.tolist()} == corners


def test_a_gltf_may_cut_holes_and_have_a_colour(tmp_path: Path) -> None:
    factors = {"baseColorFactor": [0.5, 0.25, 1, 1], "roughnessFactor": 0.3}
    file = changed_gltf(tmp_path, pbrMetallicRoughness=factors, alphaMode="MASK", alphaCutoff=0.7)
    (material,) = look_of(file).materials
    assert material.color == (0.5, 0.25, 1.0)
    assert (material.roughness, material.alpha_cutoff, material.texture) == (0.3, 0.7, None)


def test_damaged_materials_are_refused_by_name(tmp_path: Path) -> None:
    link = {"index": 9}
    file = changed_gltf(tmp_path, pbrMetallicRoughness={"baseColorTexture": link})
    with pytest.raises(ValueError, match=r"cube\.gltf: its materials are damaged"):
        _ = file.appearance


@pytest.mark.parametrize("file", [("cube.off", off()), ("cube.stl", stl("binary"))])
def test_other_formats_have_none(file: tuple[str, bytes]) -> None:
    assert SurfaceFile(*file).appearance is None


def test_only_files_in_the_folder_are_taken_along(tmp_path: Path) -> None:
    """A file from a stranger must not make a model contain the user's other files."""
    folder = tmp_path / "body"
    (folder / "skins").mkdir(parents=True)
    (tmp_path / "secret.png").write_bytes(PNG)
    (folder / "skins" / "own.png").write_bytes(PNG)
    lines = "newmtl red\nmap_Kd ../secret.png\nnewmtl blue\nmap_Kd skins\\own.png\n"
    (folder / "cube.mtl").write_text(lines, encoding="utf-8")
    (folder / "cube.obj").write_bytes(obj(""))
    file = open_surface(folder / "cube.obj")
    assert set(file.beside) == {"cube.mtl", "skins\\own.png"}
    assert look_of(file).missing == ("../secret.png",)


def test_materials_are_written_beside_a_posed_surface(tmp_path: Path) -> None:
    beside = {"cube.mtl": MTL, "skins\\own.png": PNG, "../secret.png": PNG, "kept.png": PNG}
    file = SurfaceFile("cube.obj", obj(""), beside=beside)
    folder = tmp_path / "posed"
    folder.mkdir()
    (folder / "kept.png").write_bytes(b"the user's")
    file.write(folder / "posed.obj", 2.0 * file.vertices)
    assert (folder / "cube.mtl").read_bytes() == MTL
    assert (folder / "skins" / "own.png").read_bytes() == PNG
    assert (folder / "kept.png").read_bytes() == b"the user's"
    assert [path.name for path in tmp_path.iterdir()] == ["posed"], "nothing outside"
    again = open_surface(folder / "posed.obj")
    assert look_of(again).colors is not None and again.beside["cube.mtl"] == MTL


@pytest.mark.parametrize(
    ("line", "names"),
    [
        (b"mtllib red.mtl blue.MTL", ("red.mtl", "blue.MTL")),
        (b"mtllib my skin.mtl", ("my skin.mtl",)),
        (b"mtllib my skin.mtl\tblue.mtl", ("my skin.mtl", "blue.mtl")),
        (b"mtllib skin", ("skin",)),
        (b"mtllib a.mtl.bak", ("a.mtl.bak",)),
    ],
)
def test_a_line_may_name_several_libraries(line: bytes, names: tuple[str, ...]) -> None:
    """Their names may have spaces, which also separate them."""
    red, blue = b"newmtl red\nKd 1 0 0\n", b"newmtl blue\nKd 0 0 1\n"
    data = obj("").replace(b"mtllib cube.mtl", line)
    file = SurfaceFile("cube.obj", data, beside=dict(zip(names, (red, blue), strict=False)))
    assert file.refers_to == names
    look = look_of(file)
    found = {material.name: material.color for material in look.materials}
    assert found["red"] == (1.0, 0.0, 0.0)
    assert found["blue"] == ((0.0, 0.0, 1.0) if len(names) > 1 else (1.0, 1.0, 1.0))
