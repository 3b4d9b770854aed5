"""`snapspace check`: exit codes, the report, and the mended file."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import check_surface, read_surface, read_tets, write_surface, write_tets
from snapspace.mesh import compact_surface

from .conftest import Run
from .files import bar_mesh, write_raw


def open_bar(folder: Path) -> Path:
    mesh = bar_mesh()
    vertices, faces = compact_surface(mesh.vertices, mesh.surface)
    write_surface(folder / "open.ply", vertices, faces[1:])
    return folder / "open.ply"


def test_a_fine_surface_has_exit_code_0(run: Run, tmp_path: Path) -> None:
    write_surface(tmp_path / "a.obj", bar_mesh().vertices, bar_mesh().surface)
    result = run("check", tmp_path / "a.obj", "--json")
    assert result.json["fine"] and result.json["findings"] == []
    assert "ready to be filled" in result.err


def test_a_fault_has_exit_code_1_and_a_cure(run: Run, tmp_path: Path) -> None:
    file = open_bar(tmp_path)
    result = run("check", file, "--json")
    assert result.code == 1
    assert '"name": "holes"' in result.out and "Traceback" not in result.err
    assert "it is not closed: 1 hole (3 edges" in " ".join(result.err.split())
    assert f"snapspace check {file} --fix open-mended.obj" in result.err


def test_fix_writes_a_surface_that_is_fine(run: Run, tmp_path: Path) -> None:
    out = tmp_path / "mended.obj"
    report = run("check", open_bar(tmp_path), "--fix", out, "--json").json
    assert not report["fine"] and report["mended"]["fine"]
    assert report["mended"]["invented_faces"] == 1
    assert check_surface(*read_surface(out)).fine


def test_tets_are_checked_and_repaired(run: Run, tmp_path: Path) -> None:
    mesh = bar_mesh()
    write_tets(tmp_path / "a.msh", mesh)
    assert run("check", tmp_path / "a.msh").code == 0
    tets = mesh.tets.copy()
    tets[7] = tets[7][[0, 2, 1, 3]]
    write_raw(tmp_path / "b.mesh", mesh.vertices, tets)
    assert run("check", tmp_path / "b.mesh").code == 1
    assert run("check", tmp_path / "b.mesh", "--fix", tmp_path / "c.msh").code == 0
    assert len(read_tets(tmp_path / "c.msh").tets) == len(tets)


def test_mistakes_have_exit_code_2(run: Run, tmp_path: Path) -> None:
    assert "known are .obj" in run("check", tmp_path / "a.txt").error
    for command in ("check", "info"):
        assert run(command, tmp_path / "octopus").error.endswith("octopus: there is no such file")
    file = open_bar(tmp_path)
    assert "known are .obj" in run("check", file, "--fix", tmp_path / "a.msh").error
    (tmp_path / "empty.obj").write_text("")
    assert "it has no faces" in run("check", tmp_path / "empty.obj").error


def test_view_refuses_a_file_without_faces_before_it_serves(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("snapspace.cli.view.serve", lambda *_, **__: pytest.fail("it serves"))
    (tmp_path / "empty.obj").write_text("")
    assert "it has no faces" in run("view", tmp_path / "empty.obj", "--no-browser").error
