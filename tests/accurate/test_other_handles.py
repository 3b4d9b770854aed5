"""A model with some handles as the start of one with other handles on the same mesh."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import (
    AccurateModel,
    Growth,
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    Snapshots,
    StableNeoHookean,
    accurate_model,
    growing_models,
    load,
    reduce,
)
from snapspace.accurate.growing_samples import GrowingSamples
from snapspace.accurate.old_model import OldModel
from snapspace.accurate.restricted_model import restricted_model
from snapspace.accurate.solving import Solving
from snapspace.generators import creature_handles
from snapspace.snapshots import unsolved_snapshots
from snapspace.validation import solved_reference, unseen_errors

from ..shapes import interpolation_problem
from ..snapshots.creatures import adding_a_tail, posing_creature


@pytest.fixture(scope="module")
def tail(motions: PosingProblem) -> PosingProblem:
    return adding_a_tail(motions)


@pytest.fixture(scope="module")
def reference(tail: PosingProblem) -> Snapshots:
    """Full solutions for motions of the head and the tail."""
    return solved_reference(tail, samples=8)


@pytest.fixture
def start(rough_motions: AccurateModel[PosingModel]) -> PosingModel:
    """The model of the handles feet and head."""
    return rough_motions.model


@pytest.fixture(scope="module")
def preliminary(tail: PosingProblem, rough_motions: AccurateModel[PosingModel]) -> list[Growth]:
    """The impression, and the model of the old model's shapes."""
    return list(islice(growing_models(tail, start=rough_motions.model), 2))


@pytest.fixture(scope="module")
def first(preliminary: list[Growth]) -> Growth:
    return preliminary[1]


def without_impression(problem: PosingProblem, start: PosingModel, **options: Any) -> Growth:
    """The model of the old model's shapes."""
    growths = growing_models(problem, start=start, **options)
    return next(growth for growth in growths if not growth.impression)


def median_error(growth: Growth, reference: Snapshots) -> float:
    return float(np.median(unseen_errors(growth.model, reference)))


def test_the_first_model_is_far_better_than_an_impression(
    tail: PosingProblem, first: Growth, reference: Snapshots
) -> None:
    assert first.step is None and not first.impression and first.model.problem is tail
    impression = next(growing_models(tail))
    assert impression.impression
    errors = [median_error(growth, reference) for growth in (first, impression)]
    assert errors[0] < 0.2 * errors[1], errors


def test_an_impression_of_the_new_handles_comes_before_the_model(
    tail: PosingProblem, preliminary: list[Growth], reference: Snapshots
) -> None:
    impression, first = preliminary
    assert impression.impression and impression.seconds < first.seconds
    assert impression.model.dimension < 0.6 * first.model.dimension
    scratch = next(growing_models(tail))
    assert median_error(impression, reference) < 0.5 * median_error(scratch, reference)


def test_a_fit_with_the_stiffness_of_the_impression_is_as_good_as_after_a_rough_fit(
    preliminary: list[Growth], reference: Snapshots
) -> None:
    """The first model's cubature has no rough fit, and its errors are the same without it."""
    impression, first = preliminary
    problem, subspace = first.model.problem, first.model.subspace
    snapshots = impression.snapshots
    rough = reduce(problem, subspace, snapshots=snapshots)
    known = reduce(problem, subspace, snapshots=snapshots, stiffness_from=impression.model)
    assert isinstance(known, PosingModel) and isinstance(first.model, PosingModel)
    assert known.cubature is not None and first.model.cubature is not None
    assert np.array_equal(known.cubature.tets, first.model.cubature.tets)
    errors = [np.median(unseen_errors(model, reference)) for model in (known, rough)]
    assert errors[0] < 1.25 * errors[1]


def test_a_saved_model_is_the_same_start_on_any_number_of_threads(
    start: PosingModel, first: Growth, tmp_path: Path
) -> None:
    start.save(tmp_path / "old.snapspace")
    saved = load(tmp_path / "old.snapspace")
    assert isinstance(saved, PosingModel)
    problem = adding_a_tail(posing_creature(5000, StableNeoHookean()))
    again = without_impression(problem, saved, threads=1)
    np.testing.assert_array_equal(again.model.subspace.basis, first.model.subspace.basis)


def test_guesses_are_nearer_than_the_linear_response(
    tail: PosingProblem, start: PosingModel, reference: Snapshots
) -> None:
    exact = reference.displacements.array()
    old = OldModel(start, tail, most=64)
    composed = old.guesses(reference.parameters, threads=None)
    misses = [
        np.linalg.norm(guesses - exact, axis=1)
        for guesses in (composed, tail.guesses(reference.parameters))
    ]
    assert np.median(misses[0] / misses[1]) < 0.7


def moved(old: PosingProblem) -> PosingProblem:
    """The head's handle is only its upper half."""
    part = creature_handles(old.mesh)["head"]
    heights = old.mesh.vertices[part, 2]
    return old.with_handles(
        old.handles.replacing(old.handles.names[1], part[heights > np.median(heights)])
    )


def removed(old: PosingProblem) -> PosingProblem:
    """Only the tail moves; no handle that moved before is left."""
    parts = creature_handles(old.mesh)
    handles = Handles([parts["feet"], parts["tail"]])
    return PosingProblem(
        old.mesh, handles, domain=HandleBox(translation=0.3, angle=0.5), material=old.material
    )


def fixing_another(old: PosingProblem) -> PosingProblem:
    """The feet move, and the head is fixed."""
    return old.with_handles(old.handles.fixing(old.handles.names[1]))


@pytest.mark.parametrize("make", [moved, removed, fixing_another])
def test_handles_may_be_moved_removed_or_fixed(
    motions: PosingProblem, start: PosingModel, make: Any
) -> None:
    problem = make(motions)
    reference = solved_reference(problem, samples=8)
    started, impression = without_impression(problem, start), next(growing_models(problem))
    assert median_error(started, reference) < 0.5 * median_error(impression, reference)


def test_a_model_of_fewer_handles_is_available_at_once(
    motions: PosingProblem, first: Growth, rough_motions: AccurateModel[PosingModel]
) -> None:
    old = first.model
    assert isinstance(old, PosingModel)
    reference = solved_reference(motions, samples=8)
    started = next(growing_models(motions, start=old))
    assert isinstance(started.model, PosingModel) and started.model.problem is motions
    assert started.model.elastic is old.elastic, "nothing was trained"
    assert started.model.subspace is old.subspace
    reports = started.snapshots.reports
    assert reports and all(report.carried for report in reports), "nothing was solved"
    over = float(np.median(unseen_errors(rough_motions.model, reference)))
    assert median_error(started, reference) < 2.0 * over


def test_the_search_for_fewer_handles_ends_like_one_from_scratch(
    motions: PosingProblem, first: Growth
) -> None:
    old = first.model
    assert isinstance(old, PosingModel)
    met = accurate_model(motions, start=old, target_error=0.05)
    assert met.reached and met.model.elastic is old.elastic, "the restricted model meets the target"
    assert met.held_out.all(), "only the samples that judge were solved"
    target = 0.9 * met.step.error  # which the restricted model misses
    built = accurate_model(motions, start=old, target_error=target)
    scratch = accurate_model(motions, target_error=target, most_samples=len(built.snapshots))
    assert built.reached and built.step.error <= scratch.step.error, "as many samples teach less"
    # shapes of the handle that is gone would take dimensions
    assert built.model.dimension <= 1.2 * scratch.model.dimension


def test_only_a_problem_that_asks_for_less_restricts_a_model(
    motions: PosingProblem, start: PosingModel
) -> None:
    box = motions.domain
    assert isinstance(box, HandleBox)
    smaller, wider = (
        motions.with_handles(
            motions.handles,
            domain=HandleBox(
                translation=factor * box.bounds[:, :3], angle=box.bounds[:, 3:], moving=1
            ),
        )
        for factor in (0.5, 1.5)
    )
    restricted = restricted_model(start, smaller, None)
    assert restricted is not None and restricted.problem is smaller
    stiffer = posing_creature(5000, StableNeoHookean(mu=2.0))
    for other in (wider, adding_a_tail(motions), fixing_another(motions), moved(motions), stiffer):
        assert restricted_model(start, other, None) is None


def test_no_model_is_trained_where_it_is_judged(motions: PosingProblem, start: PosingModel) -> None:
    samples = GrowingSamples(motions, 20, method="sobol", seed=0, first=0, held_out=4)
    some = samples.parameters[2:8]  # the first two are held out
    near = unsolved_snapshots(motions, some, np.ones((6, motions.base.size)))
    samples.begin_with(near, near)
    samples.solve_up_to(4, Solving(), predict=lambda: start)
    np.testing.assert_array_equal(samples.trained.parameters, some[2:])


def test_a_target_that_the_first_model_meets_ends_the_search(
    tail: PosingProblem, start: PosingModel
) -> None:
    built = accurate_model(tail, start=start, target_error=0.03)
    assert built.reached and len(built.steps) == 1
    assert built.held_out.all(), "only the samples that judge were solved"
    tight = accurate_model(tail, start=start, target_error=0.8 * built.step.error, most_samples=56)
    assert tight.step.error < built.step.error and len(tight.snapshots) > len(built.snapshots)


def test_bad_starts_are_refused(tail: PosingProblem, start: PosingModel) -> None:
    other = posing_creature(6000, StableNeoHookean())
    with pytest.raises(ValueError, match="another mesh"):
        accurate_model(other, start=start)
    with pytest.raises(ValueError, match="only handles of a posing model can change"):
        accurate_model(interpolation_problem(), start=start)
    bare = replace(
        start,
        training_parameters=start.training_parameters[:0],
        training_coordinates=start.training_coordinates[:0],
    )
    with pytest.raises(ValueError, match="made without snapshots"):
        accurate_model(tail, start=bare)


def test_held_out_motions_are_not_those_of_the_old_model_in_a_wider_box(
    motions: PosingProblem, start: PosingModel
) -> None:
    """With the same seed their angles would be those of training motions: errors seem smaller."""
    box = motions.domain
    wider = motions.with_handles(
        motions.handles, domain=replace(box, translation=1.2 * np.array(box.translation))
    )
    built = accurate_model(wider, start=start, target_error=0.9)
    judging = built.snapshots.parameters[built.held_out]
    apart = wider.domain.to_unit(judging)[:, None] - box.to_unit(start.training_parameters)
    assert np.abs(apart).max(axis=2).min() > 0.01
    again = accurate_model(wider, start=start, target_error=0.9)
    assert np.array_equal(again.snapshots.parameters, built.snapshots.parameters)
