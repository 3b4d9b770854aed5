"""`build --shell` and problem files of shells: from an open surface to posed files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import (
    ARAP,
    PosingModel,
    ShellMesh,
    load,
    read_problem,
    read_problem_surface,
    read_surface,
    stuff_surface,
    write_surface,
)
from snapspace.cli.filling_options import filled, naming_shells
from snapspace.filling import SurfaceFilling
from snapspace.filling.surface_filling import EXACTLY
from snapspace.generators import bar
from snapspace.problem import problem_content

from ..shells.sheets import sheet
from .conftest import Run
from .odd_surfaces import block, together

SMALL = ("--samples", 14, "--dimension", 6)


@pytest.fixture
def surface(tmp_path: Path) -> Path:
    """A sheet of length 1.5, whose file has a seam: vertices in the middle are there twice."""
    mesh = sheet(6, 4, size=(1.5, 1.0))
    points, faces = mesh.vertices, mesh.triangles.copy()
    middle = np.flatnonzero(points[:, 0] == 0.75)
    right = points[faces].mean(axis=1)[:, 0] > 0.75
    again = np.arange(len(points))
    again[middle] = len(points) + np.arange(len(middle))
    faces[right] = again[faces[right]]
    path = tmp_path / "sheet.obj"
    write_surface(path, np.vstack([points, points[middle]]), faces)
    return path


def problem(folder: Path, **changes: Any) -> Path:
    content = {
        "domain": {"translation": 0.2, "angle_degrees": 20},
        "handles": [
            {"name": "left", "boxes": [[[None, None, None], [0.3, None, None]]]},
            {"name": "right", "boxes": [[[1.2, None, None], [None, None, None]]]},
        ],
    }
    path = folder / "sheet.json"
    path.write_text(json.dumps(content | changes), encoding="utf-8")
    return path


SHELL = {"surface": "sheet.obj", "body": {"shell": {"thickness": 0.05}}}


@pytest.mark.parametrize(
    ("changes", "elements"),
    [
        ({}, "rigid neighbourhoods"),
        ({"material": {"model": "stable-neo-hookean"}}, "triangles and hinges"),
    ],
)
def test_a_surface_becomes_a_shell_and_comes_back_posed(
    run: Run, surface: Path, tmp_path: Path, changes: dict[str, Any], elements: str
) -> None:
    model = tmp_path / "sheet.snapspace"
    given = problem(tmp_path, **changes)
    built = run(
        "build", "--problem", given, surface, "--shell", 0.05, *SMALL, "-o", model, "--json"
    )
    figures = built.json
    assert figures["snapshots"]["inverted_tets_max"] is None
    assert (figures["vertices"], figures["triangles"]) == (35, 48)
    loaded = load(model)
    assert isinstance(loaded, PosingModel) and isinstance(loaded.problem.mesh, ShellMesh)
    assert loaded.problem.mesh.thickness == 0.05

    posed = tmp_path / "posed.obj"
    turn = ["--handle", "right", "--translate", "0,0,0.1"]
    result = run("pose", model, *turn, "-o", posed, "--json")
    assert result.code == 0 and result.json["inverted_tets"] is None
    judged = run("validate", model, "--samples", 2)
    info = run("info", model)
    said = built.err + result.err + judged.err + info.err
    assert "unseen motions are off by" in info.err
    assert "inverted tets" not in said, "a shell has no tets"
    vertices, faces = read_surface(posed)
    at_rest, same = read_surface(surface)
    np.testing.assert_array_equal(faces, same)
    np.testing.assert_array_equal(vertices[35:], vertices[:35][at_rest[:35, 0] == 0.75])
    assert vertices[:, 2].max() == pytest.approx(0.1, abs=0.01)

    told = run("info", model, "--json").json
    assert told["mesh"]["boundary_edges"] == 20 and told["mesh"]["components"] == 1
    assert elements in told["energy"]


def test_a_problem_file_describes_a_shell(run: Run, surface: Path, tmp_path: Path) -> None:
    named = problem(tmp_path, **SHELL)
    read = read_problem(named)
    assert isinstance(read.mesh, ShellMesh) and len(read.mesh.vertices) == 35
    shown = read_problem_surface(named, read.mesh)
    assert shown is not None and shown.exact and len(shown.corners) == 40
    content = problem_content(read, surface_path="sheet.obj")
    named.write_text(json.dumps(content), encoding="utf-8")
    assert read_problem(named).fingerprint == read.fingerprint
    model = tmp_path / "sheet.snapspace"
    assert run("build", "--problem", named, *SMALL, "-o", model).code == 0
    result = load(model)
    assert result.problem.fingerprint == read.fingerprint  # type: ignore[attr-defined]


def test_thickness_may_be_given_triangle_by_triangle(surface: Path, tmp_path: Path) -> None:
    thickness = np.linspace(0.01, 0.05, 48).tolist()
    named = problem(tmp_path, **(SHELL | {"body": {"shell": {"thickness": thickness}}}))
    assert read_problem(named).mesh.volume == pytest.approx(1.5 * np.mean(thickness))


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"body": {"shell": {}}}, "body.shell: the entry 'thickness' is missing"),
        ({"body": {"shell": {"thickness": "thin"}}}, "body.shell.thickness must be a number"),
        ({"body": {"shell": {"thickness": -1}}}, "thickness is -1.0, but it must be positive"),
        ({"body": {"plate": {}}}, "body: unknown entry 'plate'; known are shell"),
        ({"mesh": "bar.msh"}, "a shell is made of the entry 'surface', not of 'mesh'"),
        ({"material": {"model": "corotational"}}, "a shell cannot be made of fixed corotational"),
    ],
)
def test_what_is_no_shell_is_refused(
    surface: Path, tmp_path: Path, changes: dict[str, Any], fault: str
) -> None:
    with pytest.raises(ValueError, match=fault):
        read_problem(problem(tmp_path, **(SHELL | changes)))


def test_tets_are_no_shell(run: Run, tmp_path: Path) -> None:
    result = run(
        "build", "--problem", problem(tmp_path), "x.msh", "--shell", 0.1, "-o", "m.snapspace"
    )
    assert "a shell is made of a surface" in result.error


def test_a_surface_as_rigid_as_possible_is_built_and_described(
    run: Run, surface: Path, tmp_path: Path
) -> None:
    model = tmp_path / "arap.snapspace"
    given = problem(tmp_path, **SHELL, material={"model": "arap", "mu": 2.0})
    run("build", "--problem", given, *SMALL, "-o", model)
    loaded = load(model)
    assert loaded.problem.material == ARAP(mu=2.0)
    assert "vertices with their triangles" in " ".join(run("info", model).err.split())


def test_a_sheet_that_cannot_be_filled_may_be_a_shell(
    run: Run, surface: Path, tmp_path: Path
) -> None:
    advice = "or, for a sheet such as cloth, give --shell THICKNESS, which makes it a shell"
    words = ("-o", tmp_path / "sheet.snapspace")
    build = run("build", "--problem", problem(tmp_path), surface, *words)
    assert "encloses no volume" in build.error and advice in build.error
    vertices, faces = read_surface(surface)
    longer = tmp_path / "longer.obj"
    write_surface(longer, vertices * [1.3, 1.0, 1.0], faces)
    blend = run("interpolate", surface, longer, *words)
    assert "encloses no volume" in blend.error and advice in blend.error


def test_a_closed_surface_is_no_sheet() -> None:
    vertices, faces = together(block(), block(y=3.0))
    with pytest.raises(ValueError, match=r"remove all but one$"), naming_shells(vertices, faces):
        stuff_surface(vertices, faces)


def test_the_notice_says_why_quick_tets_fail(
    surface: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An open surface is not too thin for them."""
    filling = SurfaceFilling()

    def fill(_: object, vertices: Any, faces: Any, *, stage: Any) -> Any:
        stage(EXACTLY)
        return bar(2, 1, 1)

    monkeypatch.setattr(SurfaceFilling, "fill", fill)
    filled(surface.name, *read_surface(surface), filling)
    assert "sheet.obj is open; fTetWild guesses its inside" in capsys.readouterr().err
    closed = surface.with_name("block.obj")
    write_surface(closed, *block())
    filled(closed.name, *block(), filling)
    assert "block.obj has parts or gaps too thin" in capsys.readouterr().err
