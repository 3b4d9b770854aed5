"""Motions as accurate as asked, in the median of motions that the model was not made from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import PosingProblem, Validation, validate
from snapspace.accurate import AccurateModel, accurate_model, usual_most_samples
from snapspace.accurate.plan import FEWER_SAMPLES, MOTIONS
from snapspace.accurate.solving import Solving

from ..snapshots.creatures import adding_a_tail


@pytest.fixture
def problem(motions: PosingProblem) -> PosingProblem:
    return motions


@pytest.fixture
def usual(usual_motions: AccurateModel) -> AccurateModel:
    return usual_motions


@pytest.fixture(scope="module")
def checked(usual_motions: AccurateModel) -> Validation:
    return validate(usual_motions.model, samples=20)


def test_unseen_motions_are_as_accurate_as_asked(usual: AccurateModel, checked: Validation) -> None:
    """Motions that did not judge the model are accurate too, by tighter solutions."""
    assert usual.reached and usual.step.error <= usual.target == 0.003
    assert usual.step.projection <= usual.step.error, "projections are the best possible"
    assert usual.step.error <= usual.step.ninth
    assert np.median(checked.error) < 1.5 * usual.target


def test_samples_that_judge_a_model_do_not_train_it(usual: AccurateModel) -> None:
    unseen = usual.snapshots.parameters[usual.held_out]
    apart = np.abs(usual.model.training_parameters[:, None] - unseen).max(axis=2)
    assert apart.min() > 1e-6
    trained = int((~usual.held_out).sum())
    assert len(usual.model.training_parameters) == trained


def test_its_frames_know_their_errors(usual: AccurateModel, checked: Validation) -> None:
    """The samples that judge the model calibrate it: estimates for others are about right."""
    estimator = usual.model.error_estimator
    assert estimator is not None and len(estimator.residual_ratios) == usual.held_out.sum()
    session, estimates = usual.model.session(), []
    for w in checked.reference.parameters:
        session.reset()
        session.set_parameters(w)
        estimates.append(session.certificate(confidence=0.8).relative)
    assert 0.7 < np.median(checked.error / estimates) < 1.4


def test_a_smaller_target_takes_more(usual: AccurateModel, rough_motions: AccurateModel) -> None:
    assert rough_motions.target > 3 * usual.target
    assert rough_motions.reached and rough_motions.step.error > usual.step.error
    assert rough_motions.model.dimension < usual.model.dimension


def test_it_is_the_same_on_any_number_of_threads(
    problem: PosingProblem, usual: AccurateModel
) -> None:
    again = accurate_model(problem, threads=1)
    assert again.steps == usual.steps
    np.testing.assert_array_equal(again.model.subspace.basis, usual.model.subspace.basis)


def test_large_meshes_get_fewer_samples_by_default(
    problem: PosingProblem, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert usual_most_samples(problem) == MOTIONS.most_samples
    vertices = len(problem.mesh.vertices)
    for most, enough, allowed in (
        (800, 421, 800),  # the vertices of so many samples
        (100, 421, 421),  # what the most dimensions need
        (100, 300, 300),
        (1, 1, FEWER_SAMPLES),
    ):
        fewer = replace(MOTIONS, most_vertices=most * vertices, enough_vertices=enough * vertices)
        monkeypatch.setattr("snapspace.accurate.plan.MOTIONS", fewer)
        assert usual_most_samples(problem) == allowed


def test_samples_of_large_bodies_are_solved_loosely_unless_they_judge(
    problem: PosingProblem, monkeypatch: pytest.MonkeyPatch
) -> None:
    usual, judging = Solving().usual(problem), Solving().judging(problem)
    monkeypatch.setattr("snapspace.accurate.plan.FEWER_SAMPLES", usual_most_samples(problem))
    assert usual.tolerance is not None
    assert Solving().usual(problem).tolerance == pytest.approx(10 * usual.tolerance)
    assert Solving().judging(problem) == judging


def test_parts_of_samples_are_combined_where_samples_run_out(motions: PosingProblem) -> None:
    """What the head does in one sample is combined with what the tail does in another."""
    both = adding_a_tail(motions)
    lines: list[str] = []
    built = accurate_model(both, target_error=1e-3, most_samples=60, tell=lines.append)
    *whole, widened = built.steps
    assert not built.reached and lines[-2].endswith("parts of samples are combined")
    assert widened.dimension > (~built.held_out).sum() > whole[-1].dimension
    assert widened.error < 0.8 * min(step.error for step in whole) and built.step is widened
    coarse = accurate_model(both, target_error=1e-3, most_samples=60, budget=1e-9)
    assert coarse.step == whole[0], "there was no time for more"


def test_whole_samples_are_enough_where_they_meet_the_target(motions: PosingProblem) -> None:
    lines: list[str] = []
    built = accurate_model(motions, target_error=0.05, most_samples=30, tell=lines.append)
    assert built.reached and not any("parts of samples" in line for line in lines)
