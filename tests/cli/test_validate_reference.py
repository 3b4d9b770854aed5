"""`snapspace validate` with known full solutions: parts of the error, a picture, advice."""

from __future__ import annotations

import json
import shlex
import shutil
from pathlib import Path

import pytest
from PIL import Image

from snapspace import load, load_snapshots
from snapspace.cli import main

from .conftest import Run
from .files import write_problem

FIGURES = ("samples", "error", "projection_error", "energy_ratio", "inverted_tets")


@pytest.fixture(scope="module")
def built_few(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bar in the default material, with one tet per mode. Tests must not write to it."""
    folder = tmp_path_factory.mktemp("few")
    problem = write_problem(folder, material={"model": "stable-neo-hookean"})
    path = folder / "few.snapspace"
    words = ["--samples", "60", "--dimension", "24", "--tets", "24"]
    assert main(["build", "--problem", str(problem), *words, "-o", str(path)]) == 0
    return path


@pytest.fixture
def few_tets(built_few: Path, tmp_path: Path) -> Path:
    """A copy of the model and its problem in their own folder."""
    shutil.copytree(built_few.parent, tmp_path / "few")
    return tmp_path / "few" / built_few.name


def test_a_saved_reference_gives_the_same_figures(run: Run, model: Path, tmp_path: Path) -> None:
    kept = tmp_path / "bar.samples"
    first = run("validate", model, "--samples", 4, "--save-reference", kept, "--json").json
    assert len(load_snapshots(kept, load(model).problem)) == first["samples"] == 4
    again = run("validate", model, "--reference", kept, "--json").json
    assert {key: again[key] for key in FIGURES} == {key: first[key] for key in FIGURES}


def test_a_picture_and_its_figures_come_from_one_set_of_solves(
    run: Run, model: Path, tmp_path: Path
) -> None:
    picture = tmp_path / "error.png"
    result = run("validate", model, "--samples", 4, "--plot", picture, "--json")
    curve = result.json["curve"]
    assert [entry["dimension"] for entry in curve][-1] == 10
    assert curve[-1]["error"] == result.json["error"]
    least = [entry["projection_error"]["max"] for entry in curve]
    assert least == sorted(least, reverse=True)
    assert "errors by dimension, 4 unseen samples" in result.err
    with Image.open(picture) as image:
        assert image.size == (1120, 420)


def test_parts_are_shown_when_asked_for(run: Run, model: Path, blend_model: Path) -> None:
    result = run("validate", model, "--samples", 3, "--split", "--json")
    split = result.json["split"]
    assert split["samples"] == 3 and split["cubature"]["max"] == 0.0, "its energy is exact"
    assert split["error"]["max"] == pytest.approx(result.json["error"]["max"], rel=1e-4)
    assert "parts of the error, 3 unseen samples" in result.err
    assert run("validate", model, "--samples", 3, "--json").json["split"] is None
    blends = run("validate", blend_model, "--samples", 3, "--split", "--json").json["split"]
    assert 0 < blends["subspace"]["median"] <= blends["error_of_all_tets"]["median"]


def test_the_advised_command_runs_and_lowers_the_error(
    run: Run, few_tets: Path, tmp_path: Path
) -> None:
    path, kept = few_tets, tmp_path / "bar.samples"
    words = ("--samples", 8, "--save-reference", kept, "--json")
    before = run("validate", path, *words)
    found = before.json["next"]
    assert found["part"] == "cubature" and "times that of the projections" in before.err
    program, *command = shlex.split(found["command"])
    assert program == "snapspace" and command[-4:-2] == ["--tets", "192"]
    assert run(*command).code == 0
    after = run("validate", command[-1], "--reference", kept, "--json").json
    assert after["error"]["median"] < 0.7 * before.json["error"]["median"]
    assert shlex.join([program, *command]) in before.err


def test_with_fewer_modes_the_advice_is_to_use_more(run: Run, few_tets: Path) -> None:
    result = run("validate", few_tets, "--samples", 8, "--dimension", 20, "--json")
    assert "the file has more modes; give a larger --dimension" in result.err
    assert result.json["next"] is None


def test_without_the_files_the_advice_is_in_python(
    run: Run, few_tets: Path, tmp_path: Path
) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    moved = few_tets.rename(elsewhere / few_tets.name)
    result = run("validate", moved, "--samples", 8, "--json")
    assert result.json["next"]["command"] is None
    assert 'in Python: parameters = ss.sample(problem.domain, 60, method="sobol")' in result.err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--reference", "r.samples", "--seed", 3), "--seed has no effect"),
        (("--reference", "none.samples"), "none.samples: there is no such file"),
        (("--plot", "error.jpg"), "error.jpg"),
        (("--save-reference", "r.npz"), "r.npz"),
    ],
)
def test_impossible_options_are_refused_before_the_work(
    run: Run, model: Path, words: tuple[object, ...], message: str
) -> None:
    assert message in run("validate", model, *words).error


def test_a_reference_of_another_problem_is_refused(
    run: Run, model: Path, blend_model: Path, tmp_path: Path
) -> None:
    kept = tmp_path / "blends.samples"
    assert run("validate", blend_model, "--samples", 2, "--save-reference", kept).code == 0
    error = run("validate", model, "--reference", kept).error
    assert "blends.samples: these samples are of another problem" in error


def test_a_build_ends_with_errors_that_validate_finds_too(run: Run, few_tets: Path) -> None:
    """It solves the first samples of `validate`; the record is in the model, shown by `info`."""
    record = load(few_tets).provenance["unseen"]
    figures = run("validate", few_tets, "--samples", record["samples"], "--json").json
    for ours, theirs in (("median", "median"), ("mean", "mean"), ("ninth", "ninth")):
        assert record[ours] == pytest.approx(figures["error"][theirs], rel=1e-9)
    assert record["inverted_tets"]["frames"]["max"] == figures["inverted_tets"]["frames_max"]
    assert record["inverted_tets"]["samples"]["shapes"] == 60
    text = " ".join(run("info", few_tets).err.split())
    assert "unseen motions are off by" in text and "inverted tets" in text
    json.dumps(record)


def test_a_bad_build_says_what_to_do(run: Run, tmp_path: Path) -> None:
    """Wild motions turn tets of the paper's material inside out, and six modes cannot follow."""
    problem = write_problem(tmp_path, domain={"translation": 2.5, "angle_degrees": 120})
    path = tmp_path / "wild.snapspace"
    words = ("--samples", 16, "--dimension", 6)
    result = run("build", "--problem", problem, *words, "-o", path)
    assert result.code == 0
    assert "more than the 0.3 % of default builds" in result.err
    larger = "--samples 32 --dimension 9 --energy exact"
    assert f"build --problem {problem} {larger} -o {tmp_path / 'wild-next.snapspace'}" in result.err
    assert load(path).provenance["unseen"]["inverted_tets"]["samples"]["median"] > 0
    assert "make the box of motions smaller" in result.err


def test_the_advice_for_a_poor_subspace_is_a_target_error(run: Run, tmp_path: Path) -> None:
    problem = write_problem(tmp_path, material={"model": "stable-neo-hookean"})
    words = ("--samples", 16, "--dimension", 6)
    result = run("build", "--problem", problem, *words, "-o", tmp_path / "m.snapspace")
    assert f"build --problem {problem} --target-error 0.003 -o" in result.err
