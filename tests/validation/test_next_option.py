"""The advice after a validation, and that it helps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import snapspace as ss
from snapspace import InterpolationModel, PosingModel, next_option, split_errors, validate
from snapspace.validation import ErrorSplit, needs_advice, solved_reference

from ..snapshots.bars import posing_bar


def split_with(part: str) -> ErrorSplit:
    """Errors whose largest part is `part`."""
    sizes = {name: np.array([0.01]) for name in ErrorSplit.__dataclass_fields__}
    return replace(ErrorSplit(**sizes), **{part: np.array([0.5])})


def few_tets() -> PosingModel:
    problem = posing_bar(bound=0.5, material=ss.StableNeoHookean())
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 60), threads=1)
    subspace = ss.snapshot_pca(snapshots, dimension=24)
    return ss.reduce(problem, subspace, snapshots=snapshots, tets=24, threads=1)


@pytest.fixture(scope="module")
def model() -> PosingModel:
    return few_tets()


def test_too_few_tets_need_only_more_tets(model: PosingModel) -> None:
    option = next_option(model, split_with("cubature"))
    assert (option.part, option.samples, option.dimension) == ("cubature", 60, 24)
    assert option.tets == 192, "the default of eight per mode, which is all"
    more = replace(
        model,
        elastic=ss.Cubature.of_tets(
            model.problem, model.subspace, np.arange(100, dtype=np.int32), np.ones(100)
        ),
    )
    assert next_option(more, split_with("cubature")).tets == len(model.problem.mesh.tets) == 192


@pytest.mark.parametrize("part", ["subspace", "stiffness"])
def test_a_poor_subspace_needs_samples_and_dimensions(model: PosingModel, part: str) -> None:
    option = next_option(model, split_with(part))
    assert (option.part, option.samples, option.dimension, option.tets) == (part, 120, 36, None)


def test_poses_do_not_count_as_solved_samples(blended_cubature_model: InterpolationModel) -> None:
    option = next_option(blended_cubature_model, split_with("stiffness"))
    assert (option.samples, option.dimension, option.method) == (60, 18, "blends")
    assert 'method="blends"' in option.python


@pytest.mark.parametrize("tets", [24, None])
def test_the_advised_calls_run_and_lower_the_error(tets: int | None, model: PosingModel) -> None:
    """For 24 tets the cure is more tets; for the default number it is a larger subspace."""
    if tets is None:
        option = next_option(model, split_with("cubature"))
        model = model_from(option.python, model.problem)
    reference = solved_reference(model.problem, samples=6, threads=1)
    before = validate(model, reference=reference)
    option = next_option(model, split_errors(model, reference))
    assert option.part == ("cubature" if tets else "stiffness")
    after = validate(model_from(option.python, model.problem), reference=reference)
    assert np.median(after.error) < 0.7 * np.median(before.error)


def model_from(calls: str, problem: ss.PosingProblem) -> PosingModel:
    names = {"ss": ss, "problem": problem}
    exec(calls, names)
    model = names["model"]
    assert isinstance(model, PosingModel)
    return model


def test_two_poses_take_sobol_points(helix_model: InterpolationModel) -> None:
    option = next_option(helix_model, split_with("stiffness"))
    assert option.method == "sobol"
    assert 'method="sobol"' in option.python, "the default of `sample` is random"


def test_an_exact_energy_stays_exact_while_it_can(posing_model: PosingModel) -> None:
    option = next_option(posing_model, split_with("stiffness"))
    assert (option.dimension, option.energy, option.tolerance) == (30, "exact", None)
    assert 'energy="exact"' in option.python


def test_samples_for_a_cubature_are_solved_tightly(cubature_model: PosingModel) -> None:
    """Default samples of the paper's material settle without equilibrium of forces."""
    option = next_option(cubature_model, split_with("cubature"))
    assert option.tolerance == cubature_model.problem.solving.tolerance
    assert "options=ss.SolverOptions(tolerance=1e-05)" in option.python


def test_with_all_tets_the_cure_is_a_larger_subspace(model: PosingModel) -> None:
    every = np.arange(len(model.problem.mesh.tets), dtype=np.int32)
    volumes = model.problem.mesh.volumes
    whole = ss.Cubature.of_tets(model.problem, model.subspace, every, volumes)
    option = next_option(replace(model, elastic=whole), split_with("cubature"))
    assert (option.dimension, option.tets) == (36, None)


def test_advice_begins_above_three_projection_errors() -> None:
    assert needs_advice(0.031, 0.01) and not needs_advice(0.03, 0.01)
