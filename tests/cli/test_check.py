"""`snapspace check`: exit codes, the report, and the mended file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from snapspace import check_surface, read_surface, read_tets, write_surface, write_tets
from snapspace.mesh import compact_surface

from ..mesh.surface_files import write_file
from ..shells.sheets import rolled, sheet
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


def test_cloth_should_be_a_shell_and_not_be_mended(run: Run, tmp_path: Path) -> None:
    """No triangles close it, because those at its corners are there already."""
    cloth = sheet(8, 5)
    file = tmp_path / "cloth.obj"
    write_surface(file, rolled(cloth.vertices, 0.4), cloth.triangles)
    result = run("check", file, "--json")
    (holes,) = json.loads(result.out)["findings"]
    assert not holes["mended"] and not holes["details"]["holes"][0]["closed_by_fix"]
    assert "--fix" not in result.err
    assert "leave a sheet such as cloth open: it is a shell" in holes["cure"]
    assert f"snapspace view {file}" in result.err
    assert f"snapspace interpolate {file} pose.obj --shell 0.0" in result.err
    fixed = json.loads(run("check", file, "--fix", tmp_path / "out.obj", "--json").out)
    assert fixed["mended"]["invented_faces"] == 0, "as the finding says"


def test_flat_cloth_is_a_shell_too(run: Run, tmp_path: Path) -> None:
    """The advice once had a thickness, but no command."""
    cloth = sheet(8, 5)
    file = tmp_path / "cloth.obj"
    write_surface(file, cloth.vertices, cloth.triangles)
    result = run("check", file, "--json")
    (flat,) = json.loads(result.out)["findings"]
    assert flat["name"] == "flat" and flat["fault"] and flat["details"]["sheet"]
    assert flat["cure"].endswith("or leave a sheet such as cloth open: it is a shell")
    assert f"snapspace view {file}" in result.err


def test_fix_writes_a_surface_that_is_fine(run: Run, tmp_path: Path) -> None:
    out = tmp_path / "mended.obj"
    report = run("check", open_bar(tmp_path), "--fix", out, "--json").json
    assert not report["fine"] and report["mended"]["fine"]
    assert report["mended"]["invented_faces"] == 1
    assert check_surface(*read_surface(out)).fine


def test_fix_says_what_it_did_and_what_is_lost(run: Run, tmp_path: Path) -> None:
    write_file(tmp_path, "obj relative")
    result = run("check", tmp_path / "cube.obj", "--fix", tmp_path / "out.obj")
    assert result.code == 0 and "dropped 1 vertex without faces" in result.err
    assert "has triangles and positions only; `build` and `view` mend cube.obj" in result.err
    again = run("check", tmp_path / "out.obj", "--fix", tmp_path / "again.obj")
    assert "snapspace: there was nothing to mend\n" in again.err
    assert "positions only" not in again.err, "it had no more"


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
