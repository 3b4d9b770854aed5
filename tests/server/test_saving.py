"""Files that a page saves are complete and readable, and never overwrite another file."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, PosingProblem, load, read_problem, write_tets
from snapspace.server.bodies import mesh_body, problem_body
from snapspace.server.body import Body
from snapspace.server.messages import Saved
from snapspace.server.saving import SavedFiles, checked_name, plain_name


@pytest.fixture
def body(posing_model: PosingModel, tmp_path: Path) -> Body:
    path = tmp_path / "bar.msh"
    write_tets(path, posing_model.problem.mesh)
    return mesh_body(path, stage=lambda stage: None)


def saved(
    files: SavedFiles,
    body: Body,
    model: PosingModel,
    *,
    name: str | None = None,
    whole: bool = True,
) -> Saved:
    return files.save(body, model.problem, model if whole else None, name=name, request=1)


def assert_same(a: PosingProblem, b: PosingProblem) -> None:
    assert a.mesh.fingerprint == b.mesh.fingerprint and a.stiffness == b.stiffness
    assert [h.vertices.tolist() for h in a.handles] == [h.vertices.tolist() for h in b.handles]
    assert a.handles.names == b.handles.names
    assert a.domain.half_widths == pytest.approx(b.domain.half_widths)  # files have degrees


def test_problem_and_model_are_read_again(body: Body, posing_model: PosingModel) -> None:
    done = saved(SavedFiles(), body, posing_model)
    assert done.mesh is None, "it is already there"
    assert done.problem is not None and done.model is not None
    assert_same(read_problem(done.problem), posing_model.problem)
    assert load(done.model).dimension == posing_model.dimension


def test_a_mesh_without_a_file_is_saved_too(posing_model: PosingModel, tmp_path: Path) -> None:
    filled = Body(name="filled", mesh=posing_model.problem.mesh, file=None, folder=tmp_path)
    done = saved(SavedFiles(), filled, posing_model, whole=False)
    assert (done.mesh, done.model) == (str(tmp_path / "filled.msh"), None)
    assert done.problem is not None
    assert_same(read_problem(done.problem), posing_model.problem)


def test_a_filled_surface_is_saved_with_its_tets(
    own_surface_model: PosingModel, tmp_path: Path
) -> None:
    mesh, surface = own_surface_model.problem.mesh, own_surface_model.surface
    filled = Body(name="own", mesh=mesh, file=None, folder=tmp_path, surface=surface)
    done = saved(SavedFiles(), filled, own_surface_model)
    assert done.surface == str(tmp_path / "own.obj") and done.problem is not None
    again = problem_body(Path(done.problem))
    assert again.surface_file == tmp_path / "own.obj" and again.surface is not None
    assert np.array_equal(again.surface.faces, surface.faces)
    points = surface.vertices(mesh.vertices)
    assert again.surface.vertices(mesh.vertices) == pytest.approx(points, abs=1e-12)
    there = saved(SavedFiles(), again, own_surface_model, name="other")
    assert there.surface is None, "it is already there"
    assert there.problem is not None
    assert problem_body(Path(there.problem)).surface_file == tmp_path / "own.obj"


def test_own_files_are_replaced_and_others_never(body: Body, posing_model: PosingModel) -> None:
    files, folder = SavedFiles(), body.folder
    foreign = folder / "bar.snapspace"
    foreign.write_text("somebody's")
    first = saved(files, body, posing_model)
    assert first.problem == str(folder / "bar-2.json")
    assert first.model == str(folder / "bar-2.snapspace")
    assert saved(files, body, posing_model) == first, "the page's own file is replaced"
    assert foreign.read_text() == "somebody's" and not (folder / "bar.json").exists()
    other = saved(SavedFiles(), body, posing_model)
    assert other.problem == str(folder / "bar-3.json"), "another page's file is not"
    edited = folder / "bar-2.json"
    edited.write_text("edited by hand")
    os.utime(edited, ns=(1, 1))
    assert saved(files, body, posing_model).problem == str(folder / "bar-4.json")
    assert edited.read_text() == "edited by hand"


def test_a_link_that_leads_elsewhere_is_not_followed(
    body: Body, posing_model: PosingModel, tmp_path: Path
) -> None:
    outside = tmp_path / "outside.txt"
    (body.folder / "bar.json").symlink_to(outside)
    done = saved(SavedFiles(), body, posing_model, whole=False)
    assert done.problem == str(body.folder / "bar-2.json") and not outside.exists()


def test_nothing_is_left_behind_where_nothing_can_be_written(
    posing_model: PosingModel, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone = Body(name="x", mesh=posing_model.problem.mesh, file=None, folder=tmp_path / "no")
    with pytest.raises(ValueError, match=r"no: cannot be written to .*start the server in"):
        saved(SavedFiles(), gone, posing_model)
    here = Body(name="x", mesh=posing_model.problem.mesh, file=None, folder=tmp_path)

    def full(*_: object) -> None:
        raise ValueError("disk full")

    monkeypatch.setattr("snapspace.server.saving.write_tets", full)
    with pytest.raises(ValueError, match="disk full"):
        saved(SavedFiles(), here, posing_model)
    assert list(tmp_path.iterdir()) == []


BAD_NAMES = ["", ".", "..", "../x", "a/b", "a\\b", "/etc/x", "C:x", ".hidden", "a\0b", "a\nb"]


@pytest.mark.parametrize("name", [*BAD_NAMES, "nul", "COM1.x", "-x", "x" * 101])
def test_names_that_are_not_plain_are_refused(name: str) -> None:
    with pytest.raises(ValueError, match="is not a plain file name"):
        checked_name(name)


def test_plain_names_are_kept_and_names_of_uploads_are_made_plain() -> None:
    for name in ("dragon", "my dragon (2)", "Drache_ä-1.2+3"):
        assert checked_name(name) == name == plain_name(name)
    assert plain_name("../../etc/pass wd.obj") == "pass wd.obj"
    assert plain_name("C:\\x\\y.obj") == "y.obj"
    assert plain_name("a\0b:c|d.obj") == "a_b_c_d.obj"
    assert plain_name("") == plain_name("..") == "mesh"
    assert plain_name("x" * 300 + ".obj").endswith(".obj") and len(plain_name("x" * 300)) == 100
