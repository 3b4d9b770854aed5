"""Greedy samples, chosen batch by batch, from the command line."""

from __future__ import annotations

from pathlib import Path

import pytest
from safetensors.numpy import load_file

from snapspace import greedy_snapshots, load, read_problem
from snapspace.cli import pipeline

from .conftest import Run
from .files import write_problem, write_tet_poses

SIZE = ("--samples", 70, "--dimension", 5)


def test_a_greedy_build_has_the_samples_of_the_library_and_says_so(
    run: Run, tmp_path: Path
) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, *SIZE, "--sampling", "greedy", "--seed", 4)
    assert run(*words, "-o", path, "--json").json["samples"] == 70
    model = load(path)
    assert model.provenance["sampling"] == {
        "method": "greedy",
        "samples": 70,
        "seed": 4,
        "scramble": True,
        "batch": 32,
        "candidates": 3,
    }
    wanted = greedy_snapshots(read_problem(problem), 70, seed=4)
    assert (model.training_parameters == wanted.parameters).all()
    assert not list(tmp_path.glob("*.partial-*"))


def test_poses_are_blended_from_greedy_samples(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    words = ("interpolate", *write_tet_poses(tmp_path), "--samples", 36, "--dimension", 5)
    assert run(*words, "--sampling", "greedy", "-o", path, "--json").json["samples"] == 36


def test_an_interrupted_greedy_build_resumes_to_the_same_model(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, *SIZE, "--sampling", "greedy", "-o")
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", interrupted)
        result = run(*words, path)
    assert (result.code, result.out) == (130, "")
    assert "interrupted: 70 of 70 samples are kept" in result.err
    assert "resuming: 70 of 70 samples were finished before" in run(*words, path).err
    at_once = tmp_path / "at_once.snapspace"
    assert run(*words, at_once).code == 0
    first, second = load_file(path), load_file(at_once)
    assert first.keys() == second.keys()
    for name in first:
        assert first[name].tobytes() == second[name].tobytes(), name


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--sampling", "greedy", "--no-scramble"), "--no-scramble is for Sobol samples"),
        (("--sampling", "random", "--no-scramble"), "--no-scramble is for Sobol samples, not for"),
    ],
)
def test_choices_that_do_not_fit_are_refused_before_the_work(
    run: Run, tmp_path: Path, words: tuple[str, ...], message: str
) -> None:
    problem = write_problem(tmp_path)
    result = run("build", "--problem", problem, *SIZE, *words, "-o", tmp_path / "m.snapspace")
    assert message in result.error
    assert not list(tmp_path.glob("*.partial-*"))
