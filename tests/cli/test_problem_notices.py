"""What is odd about a problem is named before it is sampled."""

from __future__ import annotations

from pathlib import Path

from .conftest import Run
from .files import write_problem

FEW = ("--samples", 2, "--dimension", 1, "--max-iterations", 1)


def test_motions_far_longer_than_the_body_are_named(run: Run, tmp_path: Path) -> None:
    """The bar is 4 long."""
    wide = write_problem(tmp_path, domain={"translation": [0, 500, 0], "angle_degrees": 30})
    told = run("build", "--problem", wide, *FEW, "-o", tmp_path / "wide.snapspace").err
    wanted = "handles move by up to 500, 118 times the diagonal of the mesh (4.243); the domain's"
    assert wanted in " ".join(told.split())


def test_motions_too_short_to_be_seen_are_named(run: Run, tmp_path: Path) -> None:
    short = write_problem(tmp_path, domain={"translation": 0.004, "angle_degrees": 30})
    told = run("build", "--problem", short, *FEW, "-o", tmp_path / "short.snapspace").err
    wanted = "handles move by only 0.004, 0.000943 times the diagonal of the mesh (4.243)"
    assert wanted in " ".join(told.split())


def test_handles_that_leave_no_vertex_free_are_named(run: Run, tmp_path: Path) -> None:
    left = {"name": "left", "boxes": [[[None, None, None], [2.2, None, None]]]}
    right = {"name": "right", "boxes": [[[2.3, None, None], [None, None, None]]]}
    held = write_problem(tmp_path, handles=[left, right])
    told = run("build", "--problem", held, *FEW, "-o", tmp_path / "held.snapspace").err
    assert "the handles contain all 81 vertices of the mesh" in " ".join(told.split())


def test_usual_problems_are_not_named(run: Run, tmp_path: Path) -> None:
    usual = write_problem(tmp_path, domain={"translation": 4, "angle_degrees": 30})
    told = run("build", "--problem", usual, *FEW, "-o", tmp_path / "usual.snapspace").err
    assert "diagonal" not in told and "the handles contain" not in told
