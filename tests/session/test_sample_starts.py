"""Interpolated starts: they reproduce the samples, and only jumps use them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import PosingModel
from snapspace.session.motion_space import MotionSpace
from snapspace.session.sample_starts import SampleStarts


def sample_starts(model: PosingModel) -> SampleStarts:
    return SampleStarts(MotionSpace(model), model.training_coordinates)


def test_at_a_sample_the_start_is_the_sample(posing_model: PosingModel) -> None:
    starts = sample_starts(posing_model)
    for w, q in zip(
        posing_model.training_parameters, posing_model.training_coordinates, strict=True
    ):
        found = starts(posing_model.problem.offsets(w))
        assert found == pytest.approx(q, abs=1e-4 * np.abs(posing_model.training_coordinates).max())


def test_repeated_samples_change_nothing(posing_model: PosingModel) -> None:
    twice = replace(
        posing_model,
        training_parameters=np.vstack([posing_model.training_parameters] * 2),
        training_coordinates=np.vstack([posing_model.training_coordinates] * 2),
    )
    offsets = posing_model.problem.offsets(0.4 * posing_model.problem.domain.half_widths)
    once = sample_starts(posing_model)(offsets)
    assert sample_starts(twice)(offsets) == pytest.approx(once, abs=1e-3 * np.abs(once).max())


def test_distances_are_measured_by_the_handle_energy(posing_model: PosingModel) -> None:
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


def test_a_jump_is_one_solve_from_the_interpolated_start(posing_model: PosingModel) -> None:
    session, alone = posing_model.session(), posing_model.session()
    w = 0.9 * posing_model.problem.domain.half_widths
    report = session.pose(w)
    alone.pose(w)
    alone._loop.q = sample_starts(posing_model)(posing_model.problem.offsets(w))
    again = alone.solve()
    assert report.start == "sample"
    assert report.evaluations == again.evaluations
    assert session.q == pytest.approx(alone.q, abs=1e-9)


def test_a_jump_stays_where_the_last_frame_is_lower(posing_model: PosingModel) -> None:
    """Samples may be wrong; a shape that is lower at the new motion is a better start."""
    wild = replace(
        posing_model, training_coordinates=100.0 * posing_model.training_coordinates
    ).session()
    w = 0.9 * posing_model.problem.domain.half_widths
    report = wild.pose(w)
    assert report.start == "last frame" and report.converged
    assert report.value == pytest.approx(posing_model.session().pose(w).value, rel=1e-6)


def test_a_drag_never_uses_the_samples(posing_model: PosingModel) -> None:
    session = posing_model.session()
    broken = replace(
        posing_model, training_coordinates=np.full_like(posing_model.training_coordinates, np.nan)
    ).session()
    for k in range(10):
        euler = (0.0, 0.0, 0.01 * k)
        assert broken.move("head", euler=euler).converged
        session.move("head", euler=euler)
    np.testing.assert_array_equal(session.q, broken.q)
    # a guess that is not finite is not used either
    assert broken.move("head", euler=(0.0, 0.0, 0.7)).converged
