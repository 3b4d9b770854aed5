"""A model with some handles as the start of one with other handles on the same mesh."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import (
    Growth,
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    StableNeoHookean,
    accurate_model,
    growing_models,
    load,
)
from snapspace.accurate.old_model import OldModel
from snapspace.generators import creature_handles
from snapspace.validation import solved_reference, unseen_errors

from ..shapes import interpolation_problem
from ..snapshots.creatures import posing_creature

OLD = posing_creature(5000, StableNeoHookean())
PARTS = creature_handles(OLD.mesh)
TAIL = OLD.with_handles(OLD.handles.adding("tail", PARTS["tail"]))


@pytest.fixture(scope="module")
def start() -> PosingModel:
    model = accurate_model(OLD, target_error=0.01).model
    assert isinstance(model, PosingModel)
    return model


@pytest.fixture(scope="module")
def first(start: PosingModel) -> Growth:
    return next(growing_models(TAIL, start=start))


def median_error(growth: Growth, problem: PosingProblem) -> float:
    return float(np.median(unseen_errors(growth.model, solved_reference(problem, samples=8))))


def test_the_first_model_is_far_better_than_an_impression(first: Growth) -> None:
    assert first.step is None and first.model.problem is TAIL
    impression = next(growing_models(TAIL))
    errors = [median_error(growth, TAIL) for growth in (first, impression)]
    assert errors[0] < 0.2 * errors[1], errors


def test_a_saved_model_is_the_same_start_on_any_number_of_threads(
    start: PosingModel, first: Growth, tmp_path: Path
) -> None:
    start.save(tmp_path / "old.snapspace")
    saved = load(tmp_path / "old.snapspace")
    assert isinstance(saved, PosingModel)
    fresh = posing_creature(5000, StableNeoHookean())
    problem = fresh.with_handles(fresh.handles.adding("tail", PARTS["tail"]))
    again = next(growing_models(problem, start=saved, threads=1))
    np.testing.assert_array_equal(again.model.subspace.basis, first.model.subspace.basis)


def test_guesses_are_nearer_than_the_linear_response(start: PosingModel) -> None:
    reference = solved_reference(TAIL, samples=8)
    exact = reference.displacements.array()
    old = OldModel(start, TAIL, most=64)
    composed = old.guesses(reference.parameters, threads=None)
    misses = [
        np.linalg.norm(guesses - exact, axis=1)
        for guesses in (composed, TAIL.guesses(reference.parameters))
    ]
    assert np.median(misses[0] / misses[1]) < 0.7


def moved() -> PosingProblem:
    """The head's handle is only its upper half."""
    head = OLD.mesh.vertices[PARTS["head"]]
    upper = PARTS["head"][head[:, 2] > np.median(head[:, 2])]
    return OLD.with_handles(OLD.handles.replacing(OLD.handles.names[1], upper))


def removed() -> PosingProblem:
    """Only the tail moves; no handle that moved before is left."""
    handles = Handles([PARTS["feet"], PARTS["tail"]])
    return PosingProblem(
        OLD.mesh, handles, domain=HandleBox(translation=0.3, angle=0.5), material=OLD.material
    )


def fixing_another() -> PosingProblem:
    """The feet move, and the head is fixed."""
    return OLD.with_handles(OLD.handles.fixing(OLD.handles.names[1]))


@pytest.mark.parametrize("make", [moved, removed, fixing_another])
def test_handles_may_be_moved_removed_or_fixed(start: PosingModel, make: Any) -> None:
    problem = make()
    started, impression = next(growing_models(problem, start=start)), next(growing_models(problem))
    assert median_error(started, problem) < 0.5 * median_error(impression, problem)


def test_a_target_that_the_first_model_meets_ends_the_search(start: PosingModel) -> None:
    built = accurate_model(TAIL, start=start, target_error=0.03)
    assert built.reached and len(built.steps) == 1
    assert built.held_out.all(), "only the samples that judge were solved"
    tight = accurate_model(TAIL, start=start, target_error=0.004, most_samples=110)
    assert tight.step.error < built.step.error and len(tight.snapshots) > len(built.snapshots)


def test_bad_starts_are_refused(start: PosingModel) -> None:
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
        accurate_model(TAIL, start=bare)
