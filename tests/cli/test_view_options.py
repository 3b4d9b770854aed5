"""`snapspace view` refuses options that its FILE does not need."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from snapspace import write_surface

from .conftest import Run
from .files import bar_surfaces, write_problem

EDGES = ["--edge-length", 0.1]


def tets(folder: Path) -> Path:
    write_problem(folder)
    return folder / "bar.msh"


def surface(folder: Path) -> Path:
    path = folder / "bar.obj"
    write_surface(path, *bar_surfaces()["rest"])
    return path


def model(folder: Path) -> Path:
    path = folder / "model.snapspace"
    path.write_bytes(b"not read before its options are")
    return path


def shell(folder: Path) -> Path:
    surface(folder)
    path = write_problem(folder, surface="bar.obj", body={"shell": {"thickness": 0.01}})
    content = json.loads(path.read_text(encoding="utf-8"))
    del content["mesh"]
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


REFUSED: dict[str, tuple[Callable[[Path], Path] | None, list[object], str]] = {
    "tets": (tets, EDGES, "--edge-length is for filling a surface with tets, but {} has tets"),
    "exact model": (model, ["--exact"], "--exact is for filling a surface with tets, but {} is a"),
    "exact tets": (tets, ["--exact"], "--exact is for filling a surface with tets, but {} has"),
    "problem of tets": (write_problem, EDGES, "but {} has tets already; leave it out"),
    "problem of a shell": (shell, EDGES, "but a shell is not filled; leave it out"),
    "surface as a shell": (surface, ["--shell", 0.01, *EDGES], "but a shell is not filled"),
    "model": (model, EDGES, "but {} is a model; leave it out"),
    "model as a shell": (model, ["--shell", 0.01], "{}: --shell is for surfaces"),
    "tets as a shell": (tets, ["--shell", 0.01], "{}: --shell is for surfaces"),
    "nothing as a shell": (None, ["--shell", 0.01], "--shell is for a surface as FILE"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_options_that_cannot_act_are_refused(run: Run, tmp_path: Path, name: str) -> None:
    make, words, message = REFUSED[name]
    file = None if make is None else make(tmp_path)
    given = [] if file is None else [file]
    assert message.format(file) in run("view", *given, *words, "--no-browser").error


def test_exact_is_refused_before_its_package_is_asked_for(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pytetwild", None)
    given = ["build", "--problem", write_problem(tmp_path), "-o", tmp_path / "bar.snapspace"]
    for words in (["view", model(tmp_path), "--no-browser"], given):
        error = run(*words, "--exact").error
        assert "--exact is for filling a surface with tets, but" in error
