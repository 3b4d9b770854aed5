"""`snapspace build`: the file it writes, the figures it prints, the options it takes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import load, read_problem, sample, write_surface, write_tets

from ..shapes import surface_around
from .conftest import Run
from .files import bar_mesh, contents, write_problem, write_raw

SMALL = ("--samples", 24, "--dimension", 10)


def test_json_has_the_agreed_keys_and_plausible_figures(run: Run, tmp_path: Path) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    figures = run("build", "--problem", problem, *SMALL, "-o", path, "--json").json
    assert list(figures) == [
        *("vertices", "tets", "parameters", "samples", "dimension", "energy_fraction"),
        *("seconds", "snapshots", "unseen", "model_bytes", "peak_memory_bytes"),
    ]
    stages = ["snapshots", "basis", "reduction", "unseen samples"]
    assert list(figures["seconds"]) == [*stages, "total"]
    assert list(figures["snapshots"]) == ["converged", "iterations_mean", "inverted_tets_max"]
    mesh = bar_mesh()
    assert (figures["vertices"], figures["tets"]) == (len(mesh.vertices), len(mesh.tets))
    assert (figures["parameters"], figures["samples"], figures["dimension"]) == (6, 24, 10)
    assert 0.99 < figures["energy_fraction"] < 1
    assert 0 < sum(figures["seconds"][name] for name in stages) <= figures["seconds"]["total"]
    assert figures["snapshots"]["converged"] == 24
    assert figures["snapshots"]["iterations_mean"] > 1
    assert figures["model_bytes"] == path.stat().st_size
    assert figures["peak_memory_bytes"] > 1e7  # Python with NumPy has more


def test_without_json_standard_output_stays_empty(run: Run, tmp_path: Path) -> None:
    problem = write_problem(tmp_path)
    result = run("build", "--problem", problem, *SMALL, "-o", tmp_path / "m.snapspace")
    assert (result.code, result.out) == (0, "")
    assert "24 of 24 samples converged" in result.err
    assert f"snapspace validate {tmp_path / 'm.snapspace'}" in result.err


def test_the_model_records_how_it_was_made(run: Run, tmp_path: Path) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    run("build", "--problem", problem, *SMALL, "--sampling", "sobol", "--seed", 7, "-o", path)
    model = load(path)
    record = model.provenance
    assert (record["problem"], record["mesh"]) == ("bar.json", "bar.msh")
    assert set(record["versions"]) == {"snapspace", "python", "numpy", "scipy", "core"}
    assert record["sampling"]["method"] == "sobol"
    assert record["sampling"]["seed"] == 7
    assert record["solver"]["solver"] == "fast"
    assert record["snapshots"]["converged"] == 24
    assert str(tmp_path) not in str(record)
    wanted = sample(read_problem(problem).domain, 24, method="sobol", seed=7)
    np.testing.assert_array_equal(model.training_parameters, wanted)


def test_threads_and_repetition_do_not_change_the_model(run: Run, tmp_path: Path) -> None:
    problem = write_problem(tmp_path)
    paths = [tmp_path / f"{threads}.snapspace" for threads in (1, 2)]
    for threads, path in enumerate(paths, start=1):
        run("build", "--problem", problem, *SMALL, "--threads", threads, "-o", path)
    first, second = (load_file(path) for path in paths)
    assert first.keys() == second.keys()
    for name in first:
        assert first[name].tobytes() == second[name].tobytes(), name


def test_a_mesh_argument_replaces_the_mesh_of_the_problem(run: Run, tmp_path: Path) -> None:
    problem, path = write_problem(tmp_path, mesh="missing.msh"), tmp_path / "m.snapspace"
    write_tets(tmp_path / "finer.vtu", bar_mesh(10, 2, 2))
    words = ("build", "--problem", problem, tmp_path / "finer.vtu", *SMALL, "-o", path, "--json")
    assert run(*words).json["tets"] == 240
    assert load(path).provenance["mesh"] == "finer.vtu"


@pytest.mark.parametrize("energy", ["exact", "cubature"])
def test_a_surface_that_the_problem_names_is_in_the_model(
    run: Run, tmp_path: Path, energy: str
) -> None:
    surface, mesh = surface_around(bar_mesh()), bar_mesh()
    write_surface(tmp_path / "own.obj", surface.vertices(mesh.vertices), surface.faces)
    problem, path = write_problem(tmp_path, surface="own.obj"), tmp_path / "m.snapspace"
    assert run("build", "--problem", problem, *SMALL, "--energy", energy, "-o", path).code == 0
    found = load(path).surface
    assert np.array_equal(found.faces, surface.faces)
    moved = found.vertices(1.5 * mesh.vertices + 1.0)
    assert moved == pytest.approx(1.5 * surface.vertices(mesh.vertices) + 1.0, abs=1e-9)


def test_energy_fraction_chooses_the_dimension(run: Run, tmp_path: Path) -> None:
    problem = write_problem(tmp_path)
    words = ("build", "--problem", problem, "--samples", 24, "-o", tmp_path / "m.snapspace")
    loose, tight = (
        run(*words, "--energy-fraction", share, "--json").json for share in (0.9, 0.999)
    )
    assert loose["dimension"] < tight["dimension"]
    assert loose["energy_fraction"] >= 0.9
    assert tight["energy_fraction"] >= 0.999


def test_a_grid_says_how_many_samples_it_has(run: Run, tmp_path: Path) -> None:
    words = ("--samples", 70, "--dimension", 5, "--sampling", "grid", "--json")
    result = run(
        "build", "--problem", write_problem(tmp_path), *words, "-o", tmp_path / "m.snapspace"
    )
    assert result.json["samples"] == 64
    assert "notice: the grid has 64 samples, not 70" in result.err


@pytest.mark.parametrize("solver", ["fast", "newton"])
def test_both_solvers_give_a_model(run: Run, tmp_path: Path, solver: str) -> None:
    words = ("--samples", 6, "--dimension", 3, "--solver", solver, "--json")
    problem = write_problem(tmp_path)
    figures = run("build", "--problem", problem, *words, "-o", tmp_path / "m.snapspace").json
    assert figures["snapshots"]["converged"] == 6


def test_unconverged_samples_are_left_out_but_kept_for_another_run(
    run: Run, tmp_path: Path
) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, *SMALL, "--max-iterations", 2, "-o", path)
    refused = run(*words)
    assert refused.code == 2
    assert not path.exists()
    last = refused.err.splitlines()[-1]
    assert "none of the 24 snapshots converged" in last
    assert "with --include-unconverged" in last
    assert len(list(tmp_path.glob("m.snapspace.partial-*"))) == 1

    result = run(*words, "--include-unconverged", "--json")
    assert result.json["snapshots"]["converged"] == 0
    assert "resuming: 24 of 24 samples were finished before" in result.err
    assert "24 unconverged, used anyway" in result.err
    assert not list(tmp_path.glob("m.snapspace.partial-*"))


def test_a_notice_about_the_mesh_is_one_line(run: Run, tmp_path: Path) -> None:
    problem = write_problem(tmp_path)
    inverted = bar_mesh().tets[:, [0, 2, 1, 3]]
    write_raw(tmp_path / "inverted.mesh", bar_mesh().vertices, inverted)
    words = ("build", "--problem", problem, tmp_path / "inverted.mesh", *SMALL, "-o")
    result = run(*words, tmp_path / "m.snapspace")
    lines = [line for line in result.err.splitlines() if "inverted.mesh: " in line]
    assert len(lines) == 1 and lines[0].startswith("snapspace: notice")
    assert "all 192 tets were inverted" in lines[0]


def test_repair_mends_a_mesh_that_is_refused_otherwise(run: Run, tmp_path: Path) -> None:
    problem, mesh = write_problem(tmp_path), bar_mesh()
    tets = np.vstack([mesh.tets, mesh.tets[:1]])
    write_raw(tmp_path / "double.mesh", mesh.vertices, tets)
    path = tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, tmp_path / "double.mesh", *SMALL, "-o", path)
    assert "same four vertices" in run(*words).error
    result = run(*words, "--repair", "--json")
    assert result.json["tets"] == 192
    assert "notice:" in result.err and "dropped 1 of 193 tets" in result.err


def test_an_old_model_is_replaced_and_nothing_else_is_left(run: Run, model: Path) -> None:
    problem, before = write_problem(model.parent), model.read_bytes()
    run("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", model)
    assert model.read_bytes() != before
    assert load(model).dimension == 4
    assert sorted(contents(model.parent)) == ["bar.json", "bar.msh", "bar.snapspace"]
