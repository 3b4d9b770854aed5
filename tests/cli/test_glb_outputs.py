"""New .glb files of `pose`, `animate` and `blend`: with the user's own materials, and upright."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationModel, Key, PosingModel, Timeline, load, write_timeline
from snapspace.mesh import read_surface
from snapspace.pictures import render

from ..gltf.glb_content import GlbContent
from ..own_file import own_file, with_file
from .conftest import Run

MOVE = ("--handle", "head", "--euler", "0,0,20")


@pytest.fixture
def own_model(posing_model: PosingModel, tmp_path: Path) -> Path:
    """A model whose surface is a user's .obj with a texture."""
    return with_file(posing_model, own_file(posing_model)).save(tmp_path / "own.snapspace")


def names(path: Path) -> list[str]:
    return [one["name"] for one in GlbContent(path).json["materials"]]


def test_an_animation_has_the_materials_of_the_surface(
    run: Run, own_model: Path, tmp_path: Path
) -> None:
    timeline = write_timeline(tmp_path / "a.json", Timeline("posing", (Key(0.0, {}), Key(0.2, {}))))
    nod, wave, all_modes = (tmp_path / f"{name}.glb" for name in ("nod", "wave", "all"))
    assert run("pose", own_model, *MOVE, "--path", 3, "-o", nod).code == 0
    assert run("animate", own_model, timeline, "-o", wave).code == 0
    assert run("export", own_model, "--glb", all_modes).code == 0
    assert names(nod) == names(wave) == names(all_modes) == ["cap", "skin"]
    for path in (nod, wave):
        assert "COLOR_0" not in GlbContent(path).primitive["attributes"], "handles are not tinted"


def test_handles_are_tinted_where_there_are_no_materials(
    run: Run, posing_model: PosingModel, tmp_path: Path
) -> None:
    path, out = posing_model.save(tmp_path / "bar.snapspace"), tmp_path / "nod.glb"
    assert run("pose", path, *MOVE, "--path", 3, "-o", out).code == 0
    file = GlbContent(out)
    colors = file.array(file.primitive["attributes"]["COLOR_0"])
    assert len(np.unique(colors, axis=0)) == 1 + len(posing_model.problem.handles)


def test_a_pose_is_one_shape_with_the_materials(run: Run, own_model: Path, tmp_path: Path) -> None:
    out, other = tmp_path / "out.glb", tmp_path / "out.obj"
    for path in (out, other):
        assert run("pose", own_model, *MOVE, "-o", path).code == 0
    file = GlbContent(out)
    assert names(out) == ["cap", "skin"] and "targets" not in file.primitive
    found, expected = (read_surface(path)[0] for path in (out, other))
    # points of a .glb are in another order
    np.testing.assert_allclose(np.sort(found, axis=0), np.sort(expected, axis=0), atol=1e-5)
    frames = tmp_path / "frames"
    assert run("pose", own_model, *MOVE, "--path", 2, "--format", "glb", "-o", frames).code == 0
    assert names(frames / "frame-0001.glb") == ["cap", "skin"]


def test_up_turns_new_files(run: Run, own_model: Path, tmp_path: Path) -> None:
    for words in ((), ("--path", 2), ("--path", 2, "--format", "glb")):
        out = tmp_path / ("frames" if "glb" in words else "out.glb")
        assert run("pose", own_model, *MOVE, *words, "-o", out, "--up", "z").code == 0
        file = GlbContent(out / "frame-0001.glb" if "glb" in words else out)
        assert file.json["nodes"][0]["rotation"][0] == pytest.approx(-np.sqrt(0.5))


@pytest.mark.parametrize("words", [("-o", "out.obj"), ("-o", "frames", "--path", 2), ()])
def test_up_is_refused_where_coordinates_stay(
    run: Run, own_model: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[object, ...]
) -> None:
    monkeypatch.chdir(own_model.parent)
    text = "--up is for pictures, films and new .glb files; coordinates in other files stay"
    assert text in run("pose", own_model, *MOVE, *words, "--up", "z").error


def test_up_and_a_picture_go_with_any_file(
    run: Run, own_model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("snapspace.cli.pose.render", partial(render, size=(60, 60), samples=1))
    files = ("-o", tmp_path / "out.obj", "--png", tmp_path / "out.png")
    assert run("pose", own_model, *MOVE, *files, "--up", "z").code == 0


def test_a_new_file_says_what_it_loses_of_gltf(
    run: Run, own_model: Path, posing_model: PosingModel, tmp_path: Path
) -> None:
    clothes, out = tmp_path / "clothes.glb", tmp_path / "out.glb"
    assert run("pose", own_model, *MOVE, "-o", clothes).code == 0
    moved = run("pose", own_model, *MOVE, "--surface", clothes, "--path", 2, "-o", out)
    assert moved.code == 0 and names(out) == ["cap", "skin"]
    assert "of the materials of clothes.glb the .glb file has base colours only" in moved.err
    timeline = write_timeline(tmp_path / "a.json", Timeline("posing", (Key(0.0, {}), Key(0.1, {}))))
    words = ("animate", own_model, timeline, "--surface", clothes)
    frames = json.loads(run(*words, "-o", tmp_path / "frames", "--json").out)["written"]
    assert Path(frames[0]).suffix == ".glb", "the format of --surface"
    source = load(own_model).surface.source
    assert source is not None and source.suffix == ".obj"


def test_a_blend_is_one_shape_and_a_glb_of_the_user_stays_theirs(
    run: Run, blending_model: InterpolationModel, tmp_path: Path
) -> None:
    path = blending_model.save(tmp_path / "blends.snapspace")
    count = len(blending_model.problem.poses)
    first = ("blend", path, "--weights", ",".join(["1", *["0"] * (count - 1)]))
    mine, moved = tmp_path / "mine.glb", tmp_path / "moved.glb"
    assert run(*first, "-o", mine, "--linear", "--up", "y").code == 0
    assert "targets" not in GlbContent(mine).primitive, "it is no film"
    assert (tmp_path / "mine-linear.glb").exists()
    half = ("blend", path, "--weights", ",".join(["0.5", "0.5", *["0"] * (count - 2)]))
    assert run(*half, "--surface", mine, "-o", moved).code == 0
    assert GlbContent(moved).json["nodes"] == GlbContent(mine).json["nodes"], "the user's own file"
    assert "targets" not in GlbContent(moved).primitive
