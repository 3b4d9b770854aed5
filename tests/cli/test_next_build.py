"""The command of an advice: the model's own command with the options that the advice changes."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from snapspace import InterpolationModel, PosingModel, load
from snapspace.cli.next_build import next_build
from snapspace.validation import NextOption

from .files import write_problem, write_tet_poses

TETS = NextOption("cubature", 100, 40, 320, "cubature")
LARGER = NextOption("stiffness", 200, 60, None)


def made_with(model: PosingModel, options: dict[str, Any], **record: Any) -> PosingModel:
    """The model with another record of how it was made."""
    return replace(model, provenance={**model.provenance, "options": options, **record})


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_problem(tmp_path)
    return tmp_path


@pytest.fixture
def soft_model(cubature_model: PosingModel) -> PosingModel:
    """A model of a problem file, in a material that --target-error supports."""
    record = {"problem": "bar.json", "mesh": "bar.msh", "snapshots": {"solved": 96}}
    return replace(cubature_model, problem=_neo_hookean(cubature_model), provenance=record)


def _neo_hookean(model: PosingModel) -> Any:
    problem = model.problem
    return type(problem)(problem.mesh, problem.handles, domain=problem.domain)


def words(model: PosingModel, option: NextOption, folder: Path, error: float = 0.05) -> list[str]:
    found = next_build(option, model, error, folder / "m.snapspace")
    assert found is not None
    assert found[:3] == ["build", "--problem", str(folder / "bar.json")]
    assert found[-2:] == ["-o", str(folder / "m-next.snapspace")]
    return found[3:-2]


def test_more_tets_keep_everything_else(soft_model: PosingModel, folder: Path) -> None:
    given = {"--samples": 100, "--dimension": 40, "--seed": 3, "--lumped": True, "--tets": 40}
    changed = words(made_with(soft_model, given), TETS, folder)
    wanted = "--samples 100 --dimension 40 --lumped --seed 3 --tets 320"
    assert changed == wanted.split()


def test_more_tets_after_a_target_error_repeat_what_it_chose(
    soft_model: PosingModel, folder: Path
) -> None:
    changed = words(made_with(soft_model, {"--target-error": 0.01}), TETS, folder)
    assert changed == "--samples 96 --dimension 40 --tets 320".split()


def test_a_target_error_replaces_samples_and_dimension(
    soft_model: PosingModel, folder: Path
) -> None:
    given = {"--samples": 30, "--energy-fraction": 0.99, "--seed": 3, "--tets": 9}
    assert (
        words(made_with(soft_model, given), LARGER, folder)
        == "--seed 3 --target-error 0.003".split()
    )
    finer = words(made_with(soft_model, {}), LARGER, folder, error=0.0025)
    assert finer == ["--target-error", "0.001"], "half of the error, in one digit"


def test_a_target_that_was_missed_is_not_asked_for_again(
    soft_model: PosingModel, folder: Path
) -> None:
    missed = made_with(soft_model, {"--target-error": 0.001}, accurate={"reached": False})
    assert words(missed, LARGER, folder) == "--samples 200 --dimension 60".split()


def test_the_papers_material_takes_samples_and_dimensions(
    posing_model: PosingModel, folder: Path
) -> None:
    record = {"problem": "bar.json", "mesh": "bar.msh", "options": {"--energy-fraction": 0.9}}
    model = replace(posing_model, provenance=record)
    changed = words(model, replace(LARGER, energy="exact"), folder)
    assert changed == "--samples 200 --dimension 60 --energy exact".split()


def test_another_mesh_is_part_of_the_command(soft_model: PosingModel, folder: Path) -> None:
    other = made_with(soft_model, {}, mesh="finer.msh")
    assert next_build(LARGER, other, 0.05, folder / "m.snapspace") is None
    shutil.copy(folder / "bar.msh", folder / "finer.msh")
    assert words(other, LARGER, folder)[0] == str(folder / "finer.msh")


def test_poses_are_part_of_the_command(built_blend: Path, tmp_path: Path) -> None:
    model = load(built_blend)
    assert isinstance(model, InterpolationModel)
    poses = [str(path) for path in write_tet_poses(tmp_path)]
    found = next_build(TETS, model, 0.05, tmp_path / "m.snapspace")
    assert found is not None and found[:4] == ["interpolate", *poses]
    assert found[4:-2] == "--samples 12 --dimension 8 --cubature-tets 320".split()
    Path(poses[0]).unlink()
    assert next_build(TETS, model, 0.05, tmp_path / "m.snapspace") is None


def test_a_model_without_recorded_options_has_no_command(
    soft_model: PosingModel, folder: Path
) -> None:
    assert next_build(TETS, soft_model, 0.05, folder / "m.snapspace") is None
