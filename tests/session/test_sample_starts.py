"""Starts between samples: they reproduce these, and only jumps take them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import PosingModel
from snapspace.session.motion_space import MotionSpace
from snapspace.session.sample_starts import NEIGHBOURS, SampleStarts


def starts_of(model: PosingModel) -> SampleStarts:
    return SampleStarts(MotionSpace(model), model.training_coordinates)


def test_at_a_sample_the_start_is_the_sample(posing_model: PosingModel) -> None:
    starts = starts_of(posing_model)
    for w, q in zip(
        posing_model.training_parameters, posing_model.training_coordinates, strict=True
    ):
        found = starts(posing_model.problem.offsets(w))
        assert found == pytest.approx(q, abs=1e-4 * np.abs(posing_model.training_coordinates).max())


def test_repeated_samples_do_no_harm(posing_model: PosingModel) -> None:
    twice = replace(
        posing_model,
        training_parameters=np.vstack([posing_model.training_parameters] * 2),
        training_coordinates=np.vstack([posing_model.training_coordinates] * 2),
    )
    offsets = posing_model.problem.offsets(0.4 * posing_model.problem.domain.half_widths)
    once = starts_of(posing_model)(offsets)
    assert starts_of(twice)(offsets) == pytest.approx(once, abs=1e-3 * np.abs(once).max())


def test_distances_are_those_of_the_handles_energy(posing_model: PosingModel) -> None:
    problem = posing_model.problem
    motions = MotionSpace(posing_model)
    w = np.zeros(problem.parameter_count)
    w[:3] = (0.3, -0.1, 0.2)
    offsets = problem.offsets(w)
    expected = np.sqrt(posing_model.handles.value(np.zeros(posing_model.dimension), offsets))
    assert motions.distance(offsets, np.zeros_like(offsets)) == pytest.approx(expected, rel=1e-9)


def test_a_jump_to_a_sample_starts_there(posing_model: PosingModel) -> None:
    w = posing_model.training_parameters[7]
    with_samples = posing_model.session()
    bare = replace(
        posing_model,
        training_parameters=np.zeros((0, len(w))),
        training_coordinates=np.zeros((0, posing_model.dimension)),
    ).session()
    near, far = with_samples.pose(w), bare.pose(w)
    assert near.converged
    assert near.evaluations <= far.evaluations
    assert near.value <= far.value * (1 + 1e-6)


def test_a_jump_ends_no_higher_than_from_any_neighbour(posing_model: PosingModel) -> None:
    session, alone = posing_model.session(), posing_model.session()
    half_widths = posing_model.problem.domain.half_widths
    for w in np.random.default_rng(3).uniform(-1.5, 1.5, (10, len(half_widths))) * half_widths:
        session.reset()
        report = session.pose(w)
        alone.pose(w)
        nearest = MotionSpace(posing_model).nearest(posing_model.problem.offsets(w), NEIGHBOURS)
        for q in posing_model.training_coordinates[nearest]:
            alone._loop.q = q
            assert report.value <= alone.solve().value * (1 + 1e-5)


def test_the_nearest_are_in_order(posing_model: PosingModel) -> None:
    motions = MotionSpace(posing_model)
    offsets = posing_model.problem.offsets(posing_model.training_parameters[4])
    nearest = motions.nearest(offsets, 5)
    assert nearest[0] == 4
    rest = np.delete(motions.to_samples(offsets), nearest)
    assert (np.diff(motions.to_samples(offsets)[nearest]) >= 0).all()
    assert motions.to_samples(offsets)[nearest].max() <= rest.min()


def test_a_drag_never_asks_the_samples(posing_model: PosingModel) -> None:
    session = posing_model.session()
    broken = replace(
        posing_model, training_coordinates=np.full_like(posing_model.training_coordinates, np.nan)
    ).session()
    for k in range(10):
        euler = (0.0, 0.0, 0.01 * k)
        assert broken.move("head", euler=euler).converged
        session.move("head", euler=euler)
    np.testing.assert_array_equal(session.q, broken.q)
    # and a guess that is no number is not taken either
    assert broken.move("head", euler=(0.0, 0.0, 0.7)).converged
