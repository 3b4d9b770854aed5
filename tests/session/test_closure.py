"""Sessions with a closure: nearer to full solutions, and as robust as without."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import (
    PosingModel,
    SolverOptions,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.problem import rotation_matrix
from snapspace.session.closure import FAR
from snapspace.validation import unseen_parameters

from ..shapes import bar_problem
from ..taylor import observed_order

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def model() -> PosingModel:
    """A bar with two moving handles and enough samples to interpolate in twelve parameters."""
    problem = bar_problem()
    snapshots = solve_snapshots(problem, sample(problem.domain, 240, seed=1), threads=1)
    subspace = snapshot_pca(snapshots, dimension=8)
    return reduce(problem, subspace, snapshots=snapshots, threads=1)


def inside(model: PosingModel, share: float = 0.6, seed: int = 1) -> FloatArray:
    half_widths = model.problem.domain.half_widths
    return np.random.default_rng(seed).uniform(-share, share, len(half_widths)) * half_widths


def misses(model: PosingModel, parameters: FloatArray, truths: FloatArray, closure: bool) -> float:
    """Mean distance of solutions from coordinates (k, d), each from rest."""
    session, found = model.session(closure=closure), []
    for w, q in zip(parameters, truths, strict=True):
        session.reset()
        assert session.pose(w).converged
        found.append(np.linalg.norm(session.q - q))
    return float(np.mean(found))


def test_unseen_solutions_are_nearer_to_the_full_ones(model: PosingModel) -> None:
    problem = model.problem
    parameters = unseen_parameters(problem.domain, 30, seed=1)
    full = solve_snapshots(problem, parameters, options=SolverOptions(tolerance=1e-9), threads=1)
    truths = model.subspace.row_coordinates(full.displacements)
    plain = misses(model, parameters, truths, closure=False)
    assert misses(model, parameters, truths, closure=True) < 0.9 * plain


def test_samples_are_returned_but_for_their_noise(model: PosingModel) -> None:
    samples = model.training_parameters[:20], model.training_coordinates[:20]
    assert misses(model, *samples, closure=True) < 0.5 * misses(model, *samples, closure=False)


def test_rest_stays_rest(model: PosingModel) -> None:
    session = model.session(closure=True)
    session.pose(inside(model))
    session.pose(np.zeros(model.problem.parameter_count))
    size = np.linalg.norm(model.training_coordinates, axis=1).max()
    assert np.linalg.norm(session.q) < 1e-5 * size


def test_the_gradient_is_that_of_the_value(model: PosingModel) -> None:
    session = model.session(closure=True)
    session.pose(inside(model))
    loop, q = session._loop, session.q + 0.1
    value, gradient = loop.value_and_gradient(q)
    assert value != pytest.approx(model.value(q, session._offsets), rel=1e-6), "the anchor holds"
    direction = np.random.default_rng(0).normal(size=len(q))
    hessian = loop.hessian(q)

    def remainder(step: float) -> float:
        predicted = value + step * gradient @ direction
        predicted += 0.5 * step**2 * direction @ hessian @ direction
        return float(loop.value_and_gradient(q + step * direction)[0] - predicted)

    assert observed_order(remainder) > 2.9


def test_the_report_has_the_reduced_energy_alone(model: PosingModel) -> None:
    session = model.session(closure=True)
    report = session.pose(inside(model))
    assert report.value == pytest.approx(model.value(session.q, session._offsets), rel=1e-10)


def test_far_from_all_samples_nothing_is_left_of_it(model: PosingModel) -> None:
    session, plain = model.session(closure=True), model.session()
    w = inside(model)
    session.pose(w)
    plain.pose(w)
    away = 2.0 * FAR * session._motions.spacing / np.sqrt(model.handles.S[1, 3, 3])
    for distance in (0.0, away):
        for each in (session, plain):
            each.move("foot", translation=(0.0, 0.0, 0.0))
            each.move("head", translation=(distance, 0.0, 0.0))
            each._loop.q = np.zeros(8)
            each.solve()
        same = session.q == pytest.approx(plain.q, rel=1e-4, abs=1e-6)
        assert same == (distance > 0)


def test_it_fades_without_a_jump(model: PosingModel) -> None:
    session = model.session(closure=True)
    spacing = session._motions.spacing / np.sqrt(model.handles.S[1, 3, 3])
    shapes = []
    for distance in np.linspace(0.0, 8.0 * spacing, 400):
        assert session.move("head", translation=(0.0, distance, 0.0)).converged
        shapes.append(session.q)
    steps = np.linalg.norm(np.diff(shapes, axis=0), axis=1)
    assert steps.max() < 4.0 * np.median(steps)


def test_a_drag_there_and_back_returns_to_the_same_shape(model: PosingModel) -> None:
    session, target = model.session(closure=True), inside(model)
    path = [share * target for share in np.linspace(0.3, 1.0, 40)]
    there = []
    for w in path:
        session.pose(w)
        there.append(session.q)
    for w, q in zip(path[::-1], there[::-1], strict=True):
        session.pose(w)
        assert session.q == pytest.approx(q, abs=1e-3 * np.linalg.norm(q))


def test_a_drag_starts_much_nearer_to_the_next_frame_than_the_last_one_is(
    model: PosingModel,
) -> None:
    session, w = model.session(closure=True), inside(model)
    session.pose(0.9 * w)
    last, closure = session.q, session._closures[8]
    closure.pull(session._loop, model.problem.offsets(w))
    closure.carry_along(session._loop)
    start = session.q
    assert session.pose(w).converged
    assert np.linalg.norm(start - session.q) < 0.3 * np.linalg.norm(last - session.q)


def test_posing_twice_is_posing_once(model: PosingModel) -> None:
    session, w = model.session(closure=True), inside(model)
    session.pose(0.9 * w)
    session.pose(w)
    once = session.q
    session.pose(w)
    assert session.q == pytest.approx(once, abs=1e-5 * np.linalg.norm(once))


def test_a_motion_of_all_handles_carries_the_shape_along(model: PosingModel) -> None:
    session = model.session(closure=True)
    session.pose(inside(model))
    before = session.vertices
    turn = rotation_matrix((0.3, -0.2, 0.9))
    maps = [np.column_stack([turn @ m[:, :3], turn @ m[:, 3] + 2.0]) for m in session._maps]
    for name, world in zip(model.problem.handles.names, maps, strict=True):
        session.move_affine(name, world)
    assert session.vertices == pytest.approx(before @ turn.T + 2.0, abs=1e-4)


def test_fewer_dimensions_are_those_of_the_smaller_model(model: PosingModel) -> None:
    session, small = model.session(closure=True), model.leading(5).session(closure=True)
    session.dimension = 5
    w = inside(model)
    session.pose(w)
    small.pose(w)
    assert session.q == pytest.approx(small.q, rel=1e-6, abs=1e-9)
    session.dimension = 8
    session.reset()
    session.pose(w)
    fresh = model.session(closure=True)
    fresh.pose(w)
    assert session.q == pytest.approx(fresh.q, abs=1e-5 * np.linalg.norm(fresh.q))


def test_a_jump_takes_the_lowest_of_its_starts(model: PosingModel) -> None:
    session, w = model.session(closure=True), inside(model, 1.0, seed=3)
    report = session.pose(w)
    assert report.start == "sample"
    for _, q in session._closures[8].starts(session._offsets):
        session._loop.q = q
        assert session.solve().value >= report.value * (1.0 - 1e-5)


def test_anew_after_a_drag_is_no_higher_than_a_jump_there(model: PosingModel) -> None:
    dragged, jumped, w = (
        model.session(closure=True),
        model.session(closure=True),
        inside(model, 1.0),
    )
    for share in np.linspace(0.1, 1.0, 10):
        dragged.pose(share * w)
    assert dragged.solve_anew().value <= jumped.pose(w).value * (1.0 + 1e-5)


@given(
    euler=st.tuples(*[st.floats(-10, 10)] * 3),
    shift=st.tuples(
        *[st.one_of(st.floats(-3, 3), st.floats(allow_nan=False, allow_infinity=False))] * 3
    ),
)
@settings(max_examples=30)
def test_any_motion_ends_with_numbers(
    model: PosingModel, euler: tuple[float, ...], shift: tuple[float, ...]
) -> None:
    session = model.session(closure=True)
    for name in ("head", "belly"):
        session.move(name, euler=euler, translation=shift)
        assert np.isfinite(session.q).all()
    session.reset()
    assert session.move("head", euler=(0.1, 0.0, 0.2)).converged


def test_too_few_samples_are_refused(model: PosingModel) -> None:
    few = replace(
        model,
        training_parameters=model.training_parameters[:20],
        training_coordinates=model.training_coordinates[:20],
    )
    with pytest.raises(ValueError, match=r"Session: a closure needs \d+ samples .* has 20"):
        few.session(closure=True)


def test_it_has_no_certificate(model: PosingModel) -> None:
    with pytest.raises(ValueError, match="without a closure"):
        model.session(closure=True).certificate()
