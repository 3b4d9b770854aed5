"""Shells in the server: bodies of surfaces as they are, and what a page saves of them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, ShellMesh, read_problem, write_surface
from snapspace.problem import problem_content
from snapspace.server.bodies import mesh_body, model_body, problem_body
from snapspace.server.messages import PartChoice
from snapspace.server.parts import part_factors
from snapspace.server.saving import SavedFiles
from snapspace.server.surface_regions import SurfaceRegions

from ..shells.strips import shell_model


@pytest.fixture(scope="module")
def model() -> PosingModel:
    return shell_model()


@pytest.fixture
def surface(model: PosingModel, tmp_path: Path) -> Path:
    path = tmp_path / "strip.obj"
    write_surface(path, model.problem.mesh.vertices, model.problem.mesh.surface)
    return path


def test_a_surface_is_a_body_as_it_is(model: PosingModel, surface: Path) -> None:
    body = mesh_body(surface, stage=lambda *_: None, thickness=0.1)
    assert isinstance(body.mesh, ShellMesh)
    assert len(body.mesh.vertices) == len(model.problem.mesh.vertices)
    assert body.surface is not None and body.surface.exact
    assert (body.file, body.surface_file) == (None, surface.resolve())


def test_tets_are_no_shell(tmp_path: Path) -> None:
    path = tmp_path / "bar.msh"
    path.write_text("")
    with pytest.raises(ValueError, match="a shell is made of a surface, not of tets"):
        mesh_body(path, stage=lambda *_: None, thickness=0.1)


def test_handles_chosen_on_the_surface_are_those_of_the_shell(
    model: PosingModel, surface: Path
) -> None:
    body = mesh_body(surface, stage=lambda *_: None, thickness=0.1)
    assert body.surface is not None
    found = SurfaceRegions(body.mesh, body.surface).in_tets(model.problem.handles)
    for one, other in zip(found, model.problem.handles, strict=True):
        np.testing.assert_array_equal(one.vertices, other.vertices)


def test_a_part_has_the_triangles_of_its_vertices(model: PosingModel) -> None:
    mesh = model.problem.mesh
    chosen = np.arange(20)
    part = PartChoice(name="stiff", vertices=tuple(chosen.tolist()), factor=10.0)
    factors = part_factors([part], mesh, None)
    inside = np.isin(mesh.cells, chosen).all(axis=1)
    assert inside.any() and (factors[inside] == 10.0).all()
    assert (factors[~np.isin(mesh.cells, chosen).any(axis=1)] == 1.0).all()


def test_a_saved_problem_is_the_same_shell(model: PosingModel, tmp_path: Path) -> None:
    body = model_body(model, name="strip", folder=tmp_path)
    done = SavedFiles().save(body, model.problem, model, name=None, request=1)
    assert done.mesh is None and done.problem is not None
    assert done.surface == str(tmp_path / "strip.obj")
    again = read_problem(done.problem)
    assert isinstance(again.mesh, ShellMesh)
    assert again.mesh.thickness == model.problem.mesh.thickness  # type: ignore[attr-defined]
    np.testing.assert_allclose(again.mesh.vertices, model.problem.mesh.vertices, atol=1e-12)
    opened = problem_body(Path(done.problem))
    assert isinstance(opened.mesh, ShellMesh) and opened.file is None
    assert opened.surface_file == (tmp_path / "strip.obj").resolve()


def test_a_problem_file_of_a_shell_is_not_filled(model: PosingModel, surface: Path) -> None:
    content = problem_content(model.problem, surface_path=surface.name)
    path = surface.with_suffix(".json")
    path.write_text(json.dumps(content), encoding="utf-8")
    body = problem_body(path)
    assert isinstance(body.mesh, ShellMesh) and body.problem is not None
    assert body.problem.fingerprint == model.problem.fingerprint
