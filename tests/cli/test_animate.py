"""`snapspace animate`: frames of a timeline."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from snapspace import Key, PosingModel, Timeline, write_timeline
from snapspace.mesh import read_surface

from .conftest import Run

NOD = {"head": ((0.0, 0.0, 0.4), (0.0, 0.1, 0.2))}


def test_frames_and_an_animated_mesh_are_written(
    run: Run, posing_model: PosingModel, tmp_path: Path
) -> None:
    model = tmp_path / "bar.snapspace"
    posing_model.save(model)
    timeline = tmp_path / "nod.json"
    write_timeline(timeline, Timeline("posing", (Key(0.0, {}), Key(0.5, NOD))))
    out = run("animate", model, timeline, "-o", tmp_path / "frames", "--fps", 10, "--json").out
    figures = json.loads(out)
    assert figures["frames"] == figures["converged"] == 6 and figures["keys"] == 2
    session = posing_model.session()
    session.move_all(NOD)
    vertices, _ = read_surface(figures["written"][-1])
    wanted = posing_model.surface.vertices(session.vertices)
    assert abs(vertices - wanted).max() < 1e-4
    run("animate", model, timeline, "-o", tmp_path / "nod.glb")
    assert (tmp_path / "nod.glb").read_bytes()[:4] == b"glTF"


def test_the_timeline_of_the_model_is_taken_without_a_file(
    run: Run, posing_model: PosingModel, tmp_path: Path
) -> None:
    path = tmp_path / "bar.snapspace"
    posing_model.save(path)
    assert "has no timeline" in run("animate", path).error
    file = write_timeline(tmp_path / "a.json", Timeline("posing", (Key(0.0, {}), Key(1.0, NOD))))
    record = {**posing_model.provenance, "timeline": json.loads(file.read_text())}
    replace(posing_model, provenance=record).save(path)
    assert run("animate", path, "--fps", 12, "--json").json["frames"] == 13


def test_a_wrong_timeline_is_one_line(run: Run, posing_model: PosingModel, tmp_path: Path) -> None:
    model = tmp_path / "bar.snapspace"
    posing_model.save(model)
    timeline = tmp_path / "a.json"
    write_timeline(timeline, Timeline("posing", (Key(0.0, {"tail": NOD["head"]}),)))
    error = run("animate", model, timeline).error
    assert f"{timeline}: there is no handle 'tail'; the handles are" in error


def test_the_help_names_only_options_that_there_are(run: Run) -> None:
    assert "--path" not in run("animate", "--help").out
    words = " ".join(run("blend", "--help").out.split())
    assert "Format of the files in the folder of --path" in words
