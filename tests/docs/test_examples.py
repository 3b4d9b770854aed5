"""The examples run and show what they claim; the docs have the pictures that scripts make."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

import snapspace as ss

ROOT = Path(__file__).parent.parent.parent


def test_interpolation_keeps_the_volume_that_the_linear_blend_loses(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    result = runpy.run_path(str(ROOT / "examples" / "interpolation.py"))
    rows = [line.replace("%", "").split() for line in capsys.readouterr().out.splitlines()[1:]]
    first, second, elastic, linear = np.array(rows, dtype=float).T
    assert first + second == pytest.approx(1.0)
    assert elastic.min() > 95.0
    assert linear.min() < 50.0
    # at the ends both are the poses
    assert elastic[[0, -1]] == pytest.approx(linear[[0, -1]], abs=0.1)

    vertices, faces = ss.read_surface(tmp_path / "halfway.obj")
    mesh, session = result["mesh"], result["session"]
    assert len(faces) == len(mesh.surface)
    assert session.weights == pytest.approx([0.5, 0.5])
    np.testing.assert_allclose(vertices, session.vertices[mesh.surface_vertices], atol=1e-6)


def test_the_timeline_of_the_tutorial_is_one(tmp_path: Path) -> None:
    text = (ROOT / "docs" / "tutorial-artist.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```json\n(.*?)```", text, re.DOTALL)
    file = tmp_path / "wave.json"
    file.write_text(example, encoding="utf-8")
    timeline = ss.read_timeline(file)
    assert [key.time for key in timeline.keys] == [0.0, 0.5, 1.0]
    np.testing.assert_allclose(timeline.keys[1].state["head"][0], [0.0, 0.0, np.pi / 6])
    np.testing.assert_allclose(timeline.keys[2].state["head"], np.zeros((2, 3)))  # at rest again


def test_scripts_make_all_pictures_of_the_docs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(ROOT / "docs")
    script = runpy.run_path(str(ROOT / "docs" / "make_pictures.py"))
    made = {f"{name}.png" for name in script["PICTURES"]}
    # by make_page_pictures.py, in a browser
    made |= {"page-posing.png", "page-blending.png", "page-many-poses.png", "page-choosing.png"}
    made |= {"page-mirror.png"}
    made |= {"web-component.png"}  # by make_viewer_picture.py
    made |= {"blender-posed.png", "blender-blend.png"}  # by make_blender_pictures.py
    made |= {"path-lion.png"}  # by benchmarks/blend_strip.py, from meshes outside the project
    folder = ROOT / "docs" / "pictures"
    assert made == {path.name for path in folder.iterdir() if path.is_file()}
    programs = ("table", "figure", "elephant", "evaluations", "curves")  # programs of `make paper`
    assert all(path.name.startswith(programs) for path in (folder / "paper").iterdir())
