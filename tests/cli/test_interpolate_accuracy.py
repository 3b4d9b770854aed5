"""`snapspace interpolate` without samples and dimension chooses both by the error."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from snapspace import load
from snapspace.accurate import BLENDS

from .conftest import Run, write_tet_poses


def test_it_reports_what_it_tried_and_keeps_the_record(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "m.snapspace"
    result = run("interpolate", *write_tet_poses(tmp_path), "-o", path)
    assert "error of unseen blends" in result.err
    record = load(path).provenance["accurate"]
    assert record["reached"] and record["steps"][-1]["error"] <= record["target_error"] == 0.005
    assert record["step"] == record["steps"][-1]
    assert record["step"]["dimension"] == load(path).dimension
    assert "0.5 % asked; nine of ten by less than" in " ".join(run("info", path).err.split())
    assert [file.name for file in tmp_path.glob("*samples*")] == [], "checkpoints are gone"


def test_a_target_that_is_not_met_is_reported(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("snapspace.accurate.plan.BLENDS", replace(BLENDS, most_samples=60))
    path = tmp_path / "m.snapspace"
    result = run("interpolate", *write_tet_poses(tmp_path), "--target-error", 1e-12, "-o", path)
    assert "unseen blends are" in result.err and "of --target-error" in result.err
    assert not load(path).provenance["accurate"]["reached"]


@pytest.mark.parametrize(
    "words", [("--samples", 6, "--dimension", 3), ("--sampling", "random", "--dimension", 3)]
)
def test_explicit_options_win(run: Run, tmp_path: Path, words: tuple[object, ...]) -> None:
    path = tmp_path / "m.snapspace"
    run("interpolate", *write_tet_poses(tmp_path), *words, "-o", path)
    assert "accurate" not in load(path).provenance
    assert load(path).dimension == 3


@pytest.mark.parametrize("share", ["0", "-1", "2", "nan"])
def test_a_target_error_must_be_positive(run: Run, tmp_path: Path, share: str) -> None:
    words = ("--target-error", share, "-o", tmp_path / "m.snapspace")
    result = run("interpolate", *write_tet_poses(tmp_path), *words)
    assert result.code == 2
    wanted = "must be between 0 and 1" if share == "nan" else "is not in the range 0<x<1"
    assert wanted in result.err
    assert not (tmp_path / "m.snapspace").exists()
