"""`snapspace info`: models, meshes valid or not, surfaces and problems."""

from __future__ import annotations

import importlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, load, write_surface, write_tets
from snapspace.cli.files import SURFACE_INPUTS, SURFACE_OUTPUTS, TET_INPUTS, TET_OUTPUTS
from snapspace.cli.model_info import energy_text
from snapspace.mesh import read, write

from ..clustered import TETS, clustered_model
from .conftest import Run
from .files import bar_mesh, write_problem, write_raw


def test_the_lists_of_extensions_are_those_of_the_mesh_package() -> None:
    assert list(TET_INPUTS) == list(read._READERS)
    surfaces = importlib.import_module("snapspace.mesh.surface_file.content")
    assert sorted(SURFACE_INPUTS) == sorted(surfaces.READERS)
    assert list(TET_OUTPUTS) == list(write._TET_FORMATS)
    assert list(SURFACE_OUTPUTS) == list(write._SURFACE_WRITERS)
    assert not set(TET_OUTPUTS) & set(SURFACE_OUTPUTS)


def test_a_model(run: Run, model: Path) -> None:
    result = run("info", model, "--json")
    figures, loaded = result.json, load(model)
    assert figures["kind"] == "model"
    assert figures["bytes"] == model.stat().st_size
    assert (figures["dimension"], figures["samples"], figures["parameters"]) == (10, 24, 6)
    assert figures["snapshot_energies"] == loaded.subspace.snapshot_energies.tolist()
    assert figures["energy_fraction"] == loaded.subspace.energy_fraction
    assert [handle["name"] for handle in figures["handles"]] == ["left", "right"]
    assert [handle["moves"] for handle in figures["handles"]] == [False, True]
    assert [handle["vertices"] for handle in figures["handles"]] == [9, 9]
    assert figures["domain"]["translation"] == [0.5] * 3
    np.testing.assert_allclose(figures["domain"]["angle_degrees"], 30)
    assert figures["provenance"] == loaded.provenance
    assert figures["mesh"]["tets"] == 192
    assert "right: 9 vertices, moves" in result.err
    assert all(line == line.rstrip() for line in result.err.splitlines()), "it is piped"


def test_a_model_without_a_record_is_shown_as_well(run: Run, model: Path) -> None:
    bare = replace(load(model), provenance={"seconds": "unknown", "snapshots": 3})
    bare.save(model)
    assert run("info", model, "--json").json["provenance"]["snapshots"] == 3


def test_the_errors_by_dimension_end_with_that_of_all_modes(run: Run, model: Path) -> None:
    err = run("info", model).err
    subspace = load(model).subspace
    share = 100 * np.sqrt(1 - subspace.energy_fraction)
    assert f"{share:.2g} % at d = 10" in " ".join(err.split())


def test_a_valid_mesh(run: Run, tmp_path: Path) -> None:
    """4 x 1 x 1 in cubes of side 1/2, six equal tets each, with angles of 45, 60 and 90 degrees."""
    write_tets(tmp_path / "bar.vtu", bar_mesh())
    figures = run("info", tmp_path / "bar.vtu", "--json").json
    assert figures["kind"] == "tet mesh"
    assert (figures["valid"], figures["fault"], figures["repairs"]) == (True, None, [])
    assert (figures["vertices"], figures["tets"]) == (81, 192)
    assert figures["volume"] == pytest.approx(4)
    assert figures["diagonal"] == pytest.approx(np.sqrt(18))
    assert figures["bounds"] == [[0, 0, 0], [4, 1, 1]]
    assert figures["surface"]["faces"] == 2 * (2 * 4 + 4 * 16)  # two for each square
    assert figures["dihedral_degrees"]["min"] == pytest.approx(45)
    assert figures["dihedral_degrees"]["max"] == pytest.approx(90)
    assert figures["tet_volume"]["min"] == pytest.approx(1 / 48)
    assert figures["tet_volume"]["max"] == pytest.approx(1 / 48)


def test_a_mesh_that_can_be_repaired(run: Run, tmp_path: Path) -> None:
    mesh = bar_mesh()
    tets = mesh.tets.copy()
    tets[5] = tets[5][[0, 2, 1, 3]]
    write_raw(tmp_path / "bad.mesh", mesh.vertices, tets)
    result = run("info", tmp_path / "bad.mesh", "--json")
    assert result.json["valid"] is False
    assert "tet 5" in result.json["fault"]
    assert result.json["repairs"] == ["reoriented 1 of 192 tets, which were inverted"]
    assert result.json["volume"] == pytest.approx(4)
    assert "Warning" not in result.err


def test_a_problem(run: Run, tmp_path: Path) -> None:
    figures = run("info", write_problem(tmp_path), "--json").json
    assert figures["kind"] == "problem"
    assert figures["parameters"] == 6
    assert figures["stiffness"] == 1000
    assert figures["mesh"]["vertices"] == 81


def test_a_surface(run: Run, tmp_path: Path) -> None:
    mesh = bar_mesh()
    write_surface(tmp_path / "closed.obj", mesh.vertices, mesh.surface)
    write_surface(tmp_path / "open.ply", mesh.vertices, mesh.surface[1:])
    closed, opened = (
        run("info", tmp_path / name, "--json").json for name in ("closed.obj", "open.ply")
    )
    assert (closed["kind"], closed["faces"]) == ("surface", len(mesh.surface))
    assert (closed["closed"], opened["closed"]) == (True, False)


def test_local_coordinates_are_named(cubature_model: PosingModel) -> None:
    tets = len(cubature_model.cubature.tets)
    assert energy_text(cubature_model) == f"cubature of {tets} tets"
    model = clustered_model(cubature_model, 10)
    clusters = -(-tets // TETS)
    expected = f"in {clusters} clusters with 10 local coordinates each on average"
    assert energy_text(model) == f"cubature of {tets} tets, {expected}"
