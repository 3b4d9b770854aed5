"""How `snapspace interpolate` samples: by the number of poses, unless an option decides."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import InterpolationModel, load, sample, write_tets
from snapspace.generators import lizard_poses

from .conftest import Run

SMALL = ("--samples", 12, "--dimension", 5, "--seed", 2)


def write_lizards(folder: Path, poses: int) -> list[Path]:
    meshes = lizard_poses(poses, 500, bend=0.5)
    paths = [folder / f"pose-{k}.mesh" for k in range(poses)]
    for path, mesh in zip(paths, meshes, strict=True):
        write_tets(path, mesh)
    return paths


def built(run: Run, folder: Path, poses: int, *words: Any) -> InterpolationModel:
    path = folder / "m.snapspace"
    run("interpolate", *write_lizards(folder, poses), *SMALL, *words, "-o", path)
    model = load(path)
    assert isinstance(model, InterpolationModel)
    return model


@pytest.mark.parametrize(
    ("poses", "words", "method"),
    [
        (2, (), "grid"),
        (4, (), "sobol"),
        (5, (), "blends"),
        (5, ("--sampling", "sobol"), "sobol"),
        (3, ("--sampling", "blends"), "blends"),
    ],
)
def test_the_method_follows_the_number_of_poses(
    run: Run, tmp_path: Path, poses: int, words: Any, method: Any
) -> None:
    model = built(run, tmp_path, poses, *words)
    assert model.provenance["sampling"]["method"] == method
    wanted = sample(model.problem.domain, 12, method=method, seed=2)
    np.testing.assert_array_equal(model.training_parameters[:12], wanted)


def test_handle_motions_are_not_blended(run: Run, tmp_path: Path) -> None:
    words = ("--sampling", "blends", "-o", tmp_path / "m.snapspace")
    result = run("build", "--problem", tmp_path / "none.json", *words)
    assert result.code != 0
    assert "'blends' is not one of 'random', 'sobol', 'grid', 'greedy'" in result.err
