"""`snapspace demo`: all files exist, fit together, and can be used further."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from snapspace import load, read_problem, read_surface, read_tets
from snapspace.accurate import MOTIONS
from snapspace.cli import demo_creature
from snapspace.pictures import render_row

from .conftest import Run


def small_row(*arguments: Any, **options: Any) -> Any:
    return render_row(*arguments, **{**options, "size": (60, 60), "samples": 1})


def test_demo(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demo_creature, "render_row", small_row)
    folder = tmp_path / "a" / "demo"
    words = ("--tets", 5000, "--samples", 16, "--dimension", 8)
    result = run("demo", "--output", folder, *words, "--json")
    figures = result.json
    kinds = ("html", "json", "msh", "obj", "png", "snapspace")
    names = [f"creature.{kind}" for kind in kinds]
    assert sorted(path.name for path in folder.iterdir()) == names
    assert sorted(figures["files"].values()) == [str(folder / name) for name in names]
    assert figures["build"]["samples"] == 16
    assert figures["validation"]["dimension"] == 8

    model, problem = load(folder / "creature.snapspace"), read_problem(folder / "creature.json")
    assert problem.handles.names == ("feet", "head", "tail")
    assert model.problem.mesh.fingerprint == problem.mesh.fingerprint
    assert read_tets(folder / "creature.msh").fingerprint == problem.mesh.fingerprint
    shape = demo_creature.posed_shapes(model)[demo_creature.POSE_OF_OBJ]
    vertices, _ = read_surface(folder / "creature.obj")
    np.testing.assert_array_equal(vertices, shape[problem.mesh.surface_vertices])
    with Image.open(folder / "creature.png") as image:
        assert image.width == 4 * 60
    commands = [line for line in result.err.splitlines() if line.startswith("  snapspace ")]
    assert [line.split()[1] for line in commands] == [
        "view",
        "pose",
        "validate",
        "info",
        "build",
        "build",
    ]
    monkeypatch.chdir(tmp_path)
    assert run(*commands[3].split()[1:]).code == 0


def test_without_options_it_is_as_accurate_as_a_build(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A looser default target, for a quick search."""
    monkeypatch.setattr(demo_creature, "render_row", small_row)
    monkeypatch.setattr("snapspace.cli.demo.MOTIONS", replace(MOTIONS, target=0.02))
    figures = run("demo", "--output", tmp_path / "demo", "--tets", 5000, "--json").json
    model = load(figures["files"]["snapspace"])
    assert model.provenance["accurate"]["reached"]
    assert model.provenance["accurate"]["target_error"] == 0.02
    assert model.provenance["accurate"]["step"]["dimension"] == model.dimension
    assert figures["validation"]["dimension"] == model.dimension


def test_the_poses_are_inside_the_sampled_domain() -> None:
    bounds = demo_creature.PROBLEM["domain"]
    for name, motions in demo_creature.POSES.items():
        for motion in motions.values():
            assert np.abs(motion.translation or 0).max() <= bounds["translation"], name
            assert np.abs(motion.euler or 0).max() <= bounds["angle_degrees"], name
