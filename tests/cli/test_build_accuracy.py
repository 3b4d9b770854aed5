"""`snapspace build` without samples and dimension chooses both by the error."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from snapspace import AccurateModel, SolverOptions, load, write_tets
from snapspace.accurate.solving import Solving
from snapspace.cli.target_error import BLENDS_DECIDING, MOTIONS_DECIDING
from snapspace.problem import Problem

from .conftest import Run
from .files import bar_mesh, write_problem, write_tet_poses

#: Enough for some tight solutions of the bar, but not for all.
ITERATIONS = 34


def neo_hookean(folder: Path) -> Path:
    """The bar's problem in the default material."""
    file = write_problem(folder)
    problem = json.loads(file.read_text())
    problem.pop("material", None)
    file.write_text(json.dumps(problem))
    return file


def test_it_reports_what_it_tried_and_reached(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    result = run("build", "--problem", neo_hookean(tmp_path), "--target-error", 0.05, "-o", path)
    assert "error of unseen motions" in result.err
    record = load(path).provenance["accurate"]
    assert record["reached"] and record["step"]["error"] <= record["target_error"] == 0.05
    assert record["step"]["error"] <= record["step"]["ninth"]
    for shown in (result, run("info", path)):
        assert "5 % asked; nine of ten by less than" in " ".join(shown.err.split())
    assert [file.name for file in tmp_path.glob("*samples*")] == [], "checkpoints are gone"


def test_it_says_which_unseen_motions_its_errors_leave_out(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    judging = Solving.judging

    def short(self: Solving, problem: Problem) -> SolverOptions:
        return replace(judging(self, problem), max_iterations=ITERATIONS)

    monkeypatch.setattr(Solving, "judging", short)
    words = ("build", "--problem", neo_hookean(tmp_path), "--target-error", 0.05)
    result = run(*words, "-o", tmp_path / "m.snapspace")
    assert result.code == 0
    assert "of 16 unseen motions, whose full solutions did not converge" in result.err


def test_an_old_model_is_the_start_of_one_with_other_handles(run: Run, tmp_path: Path) -> None:
    file, old, new = neo_hookean(tmp_path), tmp_path / "old.snapspace", tmp_path / "new.snapspace"
    run("build", "--problem", file, "--target-error", 0.05, "-o", old)
    problem = json.loads(file.read_text())
    problem["handles"] = problem["handles"][::-1]
    file.write_text(json.dumps(problem))
    words = ("--problem", file, "--from", old, "-o", new)
    run("build", *words, "--target-error", 0.2)
    record = load(new).provenance["accurate"]
    assert record["reached"] and record["step"]["samples"] == 16, "those that judge, and no others"
    result = run("build", *words, "--samples", 24, "--dimension", 6)
    assert result.code == 2 and "--from chooses what --samples decides" in result.err
    write_tets(tmp_path / "finer.msh", bar_mesh(9))
    result = run("build", *words, tmp_path / "finer.msh")
    told = " ".join(result.err.split())
    assert result.code == 2 and "old.snapspace: this is a model of another mesh" in told
    assert told.endswith("or leave out --from")


@pytest.mark.parametrize(
    "words",
    [("--samples", 24, "--dimension", 6), ("--tets", 40, "--samples", 24, "--dimension", 6)],
)
def test_explicit_options_win(run: Run, tmp_path: Path, words: tuple[object, ...]) -> None:
    path = tmp_path / "m.snapspace"
    run("build", "--problem", neo_hookean(tmp_path), *words, "-o", path)
    assert "accurate" not in load(path).provenance
    assert load(path).dimension == 6


@pytest.mark.parametrize("command", ["build", "interpolate"])
def test_the_help_names_all_options_that_decide_in_place_of_the_target(
    run: Run, command: str
) -> None:
    deciding = {"build": MOTIONS_DECIDING, "interpolate": BLENDS_DECIDING}[command]
    words = "".join(run(command, "--help").out.split())
    listed = ",".join("--" + name.replace("_", "-") for name in deciding)
    assert f"ifnoneof{listed}isgiven" in words
    for name in ("--solver", "--lumped", "--no-scramble", "--include-unconverged"):
        assert name in listed


def test_options_that_decide_in_place_of_the_target_are_named(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    words = ("--lumped", "--samples", 24, "--dimension", 6)
    result = run("build", "--problem", neo_hookean(tmp_path), *words, "-o", path)
    assert (
        "notice: --samples, --dimension, --lumped decide in place of --target-error, which does "
        "not apply" in result.err
    )
    assert "the size" not in result.err, "both options for it are given"
    other = run("interpolate", *write_tet_poses(tmp_path), "--lumped", "-o", path)
    assert "notice: --lumped decides in place of --target-error" in other.err
    assert "--samples and --dimension set the size" in " ".join(other.err.split())
    without = run("build", "--problem", neo_hookean(tmp_path), "--target-error", 0.05, "-o", path)
    assert "in place of" not in without.err


def test_a_budget_ends_it_early_and_says_so(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    words = ("--target-error", 1e-6, "--budget", 0.01)
    result = run("build", "--problem", neo_hookean(tmp_path), *words, "-o", path)
    text = " ".join(result.err.split())
    assert "would exceed the budget of 0.01 s" in text and "raise --budget" in text
    record = load(path).provenance["accurate"]
    assert not record["reached"] and record["step"]["samples"] == 96


def test_a_missed_target_names_the_command_that_says_why(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A guess, such as more samples, would be wrong where the tets of the cubature are too few."""
    monkeypatch.setattr(AccurateModel, "reached", False)
    path = tmp_path / "m.snapspace"
    words = ("--problem", neo_hookean(tmp_path), "--target-error", 0.2)
    text = " ".join(run("build", *words, "-o", path).err.split())
    assert f"; `snapspace validate {path} --split` says what a better model needs" in text
    assert "cubature: the energy of" in run("validate", path, "--split", "--samples", 2).err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--target-error", 0), "'--target-error': 0.0 is not in the range 0<x<1"),
        (("--target-error", 2), "'--target-error': 2.0 is not in the range 0<x<1"),
        (("--target-error", "nan"), "target error is nan, but it must be between 0 and 1"),
        (
            ("--target-error", 0.01, "--samples", 24),
            "--target-error chooses what --samples decides",
        ),
        (("--target-error", 0.01, "--tets", 24), "--target-error chooses what --tets decides"),
        (("--budget", 0), "the budget is 0.0 seconds, but it must be positive and finite"),
        (("--budget", 9, "--dimension", 6), "--budget chooses what --dimension decides"),
    ],
)
def test_options_without_effect_are_refused(
    run: Run, tmp_path: Path, words: tuple[object, ...], message: str
) -> None:
    path = tmp_path / "m.snapspace"
    result = run("build", "--problem", neo_hookean(tmp_path), *words, "-o", path)
    assert result.code == 2 and message in " ".join(result.err.split())
    assert not path.exists()


def test_the_papers_material_takes_no_target_error(run: Run, tmp_path: Path) -> None:
    file = write_problem(tmp_path)
    problem = json.loads(file.read_text())
    problem["material"] = {"model": "stvk", "lam": 1.0, "mu": 1.0}
    file.write_text(json.dumps(problem))
    result = run("build", "--problem", file, "--target-error", 0.01, "-o", tmp_path / "m.snapspace")
    assert result.code == 2 and "not for St.Venant-Kirchhoff" in " ".join(result.err.split())
