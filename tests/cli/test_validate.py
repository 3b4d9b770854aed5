"""`snapspace validate`: the agreed keys, and the figures of the library."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from snapspace import Snapshots, load, load_posing, save_snapshots, validate
from snapspace.validation import solved_reference

from .conftest import Run

STATISTICS = ["mean", "median", "ninth", "std", "max"]


def test_json_has_the_agreed_keys_and_the_figures_of_the_library(run: Run, model: Path) -> None:
    figures = run("validate", model, "--samples", 5, "--seed", 1, "--json").json
    assert list(figures) == [
        *("samples", "dimension", "error", "projection_error", "energy_ratio", "iterations"),
        *("solve_ms", "frame_ms", "inverted_tets", "lower_minima", "split", "curve", "next"),
    ]
    for name in ("error", "projection_error", "energy_ratio", "iterations"):
        assert list(figures[name]) == STATISTICS
    for name in ("solve_ms", "frame_ms"):
        assert list(figures[name]) == ["median", "max"]
        assert 0 < figures[name]["median"] <= figures[name]["max"]
    wanted = validate(load(model), samples=5, seed=1).as_json(10)
    for name in ("samples", "dimension", "error", "projection_error", "energy_ratio"):
        assert figures[name] == wanted[name]


def test_the_errors_are_ordered_as_they_must_be(run: Run, model: Path) -> None:
    figures = run("validate", model, "--samples", 5, "--json").json
    assert 0 < figures["projection_error"]["mean"] <= figures["error"]["mean"] < 1
    assert figures["energy_ratio"]["max"] >= 1 - 1e-6  # the full minimum is the lower of the two


def test_fewer_modes_are_less_accurate(run: Run, model: Path) -> None:
    few = run("validate", model, "--samples", 5, "--dimension", 3, "--json").json
    all_modes = run("validate", model, "--samples", 5, "--json").json
    assert few["dimension"] == 3
    assert few["projection_error"]["mean"] > 2 * all_modes["projection_error"]["mean"]


def test_the_table_goes_to_standard_error(run: Run, model: Path) -> None:
    result = run("validate", model, "--samples", 3)
    assert (result.code, result.out) == (0, "")
    for words in ("3 unseen samples, dimension 10", "projection error", "energy, reduced / full"):
        assert words in result.err
    assert all(line == line.rstrip() for line in result.err.splitlines()), "it is piped"


def test_another_seed_draws_other_samples(run: Run, model: Path) -> None:
    first, second = (
        run("validate", model, "--samples", 3, "--seed", seed, "--json").json for seed in (1, 2)
    )
    assert first["error"] != second["error"]


def test_a_motion_far_off_is_reported_although_the_median_is_small(
    run: Run, model: Path, tmp_path: Path
) -> None:
    """One of six full solutions is replaced by a shape near rest."""
    loaded = load_posing(model)
    solved = solved_reference(loaded.problem, samples=6, seed=1)
    displacements = solved.displacements.array()
    shapes = loaded.problem.base + displacements * np.where(np.arange(6) == 2, 0.02, 1.0)[:, None]
    file = tmp_path / "six.samples"
    wrong = Snapshots.from_shapes(loaded.problem, solved.parameters, shapes, solved.reports)
    save_snapshots(wrong, file)
    result = run("validate", model, "--reference", file)
    told = " ".join(result.err.split())
    assert "of 6 unseen motions are more than 10 % off, at most 4" in told, told
