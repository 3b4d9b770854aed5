"""Steps in time: implicit Euler in reduced coordinates."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from snapspace import (
    Dynamics,
    InterpolationModel,
    PosingModel,
    PosingSession,
    calibrate,
    reduce,
)
from snapspace.subspace import RigidFrames

REST: dict[str, Any] = {"head": ((0, 0, 0), (0, 0, 0))}
TURNED: dict[str, Any] = {"head": ((0.0, 0.3, 0.2), (0.1, 0.2, 0.0))}
UNDAMPED = Dynamics(damping=0.0)


@pytest.fixture(params=["posing_model", "cubature_model"])
def session(request: pytest.FixtureRequest) -> PosingSession:
    model: PosingModel = request.getfixturevalue(request.param)
    return model.session()


@settings(max_examples=12)
@given(
    dt=st.floats(1e-3, 1 / 15),
    angles=st.lists(st.floats(-0.8, 0.8), min_size=3, max_size=3),
    fall=st.floats(-20.0, 20.0),
)
def test_the_energy_never_grows_by_itself(
    cubature_model: PosingModel, dt: float, angles: list[float], fall: float
) -> None:
    session = cubature_model.session()
    session.dynamics = Dynamics(damping=0.0, gravity=(0.0, 0.0, fall))
    session.move("head", euler=angles)
    session.step(dt, REST)
    energies = [session.mechanical_energy]
    for _ in range(30):
        assert session.step(dt).converged
        energies.append(session.mechanical_energy)
    scale = max(map(abs, energies))
    assert np.diff(energies).max() <= 1e-9 * scale


def test_a_small_swing_is_that_of_implicit_euler(session: PosingSession) -> None:
    """Along an eigenvector: (q+ - 2 q + q-) / dt^2 = - omega^2 q+, omega at the given frequency."""
    session.dynamics = UNDAMPED
    session.tolerance = 1e-14
    hessian = session._loop.hessian(np.zeros(session.dimension))
    softest = np.linalg.eigh(hessian)[1][:, 0]
    session._loop.q = 1e-4 * session.model.coordinate_scale * softest
    dt, omega = 1 / 60, 2 * np.pi * session.dynamics.frequency
    start = before = now = session.q @ softest
    for _ in range(20):
        session.step(dt)
        before, now = now, (2 * now - before) / (1 + (omega * dt) ** 2)
        assert session.q @ softest == pytest.approx(now, rel=1e-3, abs=1e-6 * start)


def test_short_steps_swing_at_the_given_frequency(session: PosingSession) -> None:
    """Implicit Euler is of first order: halving dt halves the error of the half period."""

    def half_period(dt: float) -> float:
        session.reset()
        session.tolerance, session.dynamics = 1e-12, Dynamics(frequency=1.0, damping=0.0)
        hessian = session._loop.hessian(np.zeros(session.dimension))
        softest = np.linalg.eigh(hessian)[1][:, 0]
        session._loop.q = 1e-3 * session.model.coordinate_scale * softest
        values = [session.q @ softest]
        while len(values) * dt < 0.3 or values[-1] <= values[-2]:
            session.step(dt)
            values.append(session.q @ softest)
        a, b = values[-2] - values[-3], values[-1] - values[-2]
        return float(dt * (len(values) - 2.5 + a / (a - b)))

    errors = [abs(half_period(dt) - 0.5) for dt in (1 / 50, 1 / 100)]
    assert errors[1] < 0.02 and errors[1] < 0.7 * errors[0]


def test_it_comes_to_rest_where_the_static_solve_is(session: PosingSession) -> None:
    session.dynamics = Dynamics(damping=0.5)
    for _ in range(200):
        session.step(1 / 15, TURNED)
    swung = session.vertices
    assert np.abs(session.velocity).max() < 1e-6 * session.model.coordinate_scale
    session.move_all(TURNED)
    np.testing.assert_allclose(swung, session.vertices, atol=1e-4)


def test_a_falling_frame_feels_no_gravity(session: PosingSession) -> None:
    """With all handles falling like the body, it stays in shape (equivalence principle)."""
    fall, dt = np.array([0.3, -1.0, 0.5]), 1 / 60
    names = session.model.problem.handles.names
    session.dynamics = Dynamics(damping=0.0, gravity=(0.3, -1.0, 0.5))
    for step in range(1, 15):
        way = fall * dt**2 * step * (step + 1) / 2  # falling by implicit Euler
        session.step(dt, {name: ((0, 0, 0), way) for name in names})
    assert np.abs(session.q).max() < 1e-6 * session.model.coordinate_scale


def test_a_body_lags_behind_its_handles(session: PosingSession) -> None:
    """An accelerated frame acts like the opposite gravity."""
    push, dt = np.array([0.0, 2.0, 0.0]), 1 / 60
    names = session.model.problem.handles.names
    session.dynamics = UNDAMPED
    for step in range(1, 8):
        way = push * dt**2 * step * (step + 1) / 2
        session.step(dt, {name: ((0, 0, 0), way) for name in names})
    carried = session.q
    session.reset()
    session.dynamics = Dynamics(damping=0.0, gravity=(0.0, -2.0, 0.0))
    for _ in range(7):
        session.step(dt)
    assert np.abs(carried).max() > 1e-5 * session.model.coordinate_scale
    np.testing.assert_allclose(carried, session.q, atol=1e-3 * np.abs(carried).max())


def test_frames_project_moved_shapes(posing_model: PosingModel) -> None:
    subspace, rng = posing_model.subspace, np.random.default_rng(3)
    frames = RigidFrames(subspace)
    q = rng.normal(size=subspace.dimension)
    turn, shift = Rotation.from_rotvec([0.4, -0.2, 1.0]).as_matrix(), np.array([0.2, 1.0, -3.0])
    moved = subspace.shape(q).reshape(-1, 3) @ turn.T + shift
    expected = subspace.coordinates(moved.reshape(-1))
    np.testing.assert_allclose(frames.coordinates(turn, shift, q), expected, atol=1e-9)
    still = frames.coordinates(np.eye(3), np.zeros(3), q[:5])
    np.testing.assert_allclose(still, q[:5], atol=1e-6)


@pytest.mark.parametrize("name", ["blending_model", "blended_cubature_model"])
def test_blends_swing_and_come_to_rest(name: str, request: pytest.FixtureRequest) -> None:
    model: InterpolationModel = request.getfixturevalue(name)
    session = model.session()
    goal = np.eye(len(model.problem.poses.names))[1]
    session.step(1 / 60, goal)
    energies = [session.mechanical_energy]
    for _ in range(400):
        session.step(1 / 15)
        energies.append(session.mechanical_energy)
    assert np.diff(energies).max() <= 1e-9 * abs(energies[0])
    swung = session.vertices
    session.blend(goal)
    size = np.ptp(swung, axis=0).max()
    np.testing.assert_allclose(swung, session.vertices, atol=1e-3 * size)


def test_a_frame_that_was_not_a_step_stops_the_body(session: PosingSession) -> None:
    session.step(1 / 60, TURNED)
    assert np.abs(session.velocity).max() > 0.0
    session.move_all(REST)
    assert not session.velocity.any()
    session.step(1 / 60, TURNED)
    session.reset()
    session.step(1 / 60)
    assert np.abs(session.q).max() < 1e-9 * session.model.coordinate_scale


def test_steps_are_the_same_every_time(cubature_model: PosingModel) -> None:
    def run() -> Any:
        session = cubature_model.session()
        for k in range(6):
            session.step(1 / 60, TURNED if k < 3 else REST)
        return session.q

    np.testing.assert_array_equal(run(), run())


def test_fewer_coordinates_step_as_well(session: PosingSession) -> None:
    session.step(1 / 60, TURNED)
    session.dimension = 7
    assert session.step(1 / 60, REST).status in ("converged", "line_search_failed")
    assert len(session.velocity) == 7 and np.isfinite(session.q).all()


@pytest.mark.parametrize("dt", [0.0, -1.0, np.nan, np.inf])
def test_the_time_of_a_step_must_be_positive(session: PosingSession, dt: float) -> None:
    with pytest.raises(ValueError, match=r"step: dt .* must be positive and finite, in seconds"):
        session.step(dt)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"frequency": 0.0}, "Dynamics: frequency 0.0 must be positive, in Hz"),
        ({"frequency": np.nan}, "Dynamics: frequency nan must be positive"),
        ({"damping": -0.1}, "Dynamics: damping -0.1 must be finite and not negative"),
        ({"gravity": (0.0, 1.0)}, "Dynamics: gravity"),
        ({"gravity": (0.0, np.inf, 1.0)}, "Dynamics: gravity"),
    ],
)
def test_bad_settings_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Dynamics(**options)


def test_bad_targets_leave_the_session_as_it_was(session: PosingSession) -> None:
    session.step(1 / 60, TURNED)
    q, velocity = session.q, session.velocity
    for bad, message in (
        ({"tail": ((0, 0, 0), (0, 0, 0))}, "tail"),
        ({"head": ((0,), (0,))}, "head"),
    ):
        with pytest.raises(ValueError, match=message):
            session.step(1 / 60, bad)
    with pytest.raises(ValueError, match="dynamics must be a Dynamics, not int"):
        session.dynamics = 3  # type: ignore[assignment]
    np.testing.assert_array_equal(session.q, q)
    np.testing.assert_array_equal(session.velocity, velocity)


def test_the_energy_of_all_tets_has_no_steps(posing_model: PosingModel) -> None:
    full = reduce(posing_model.problem, posing_model.subspace.leading(5), energy="full")
    with pytest.raises(ValueError, match="energy of all tets"):
        full.session().step(1 / 60)


def test_a_moving_body_has_no_certificate(posing_model: PosingModel) -> None:
    session = calibrate(posing_model, samples=12, threads=1).session()
    session.step(1 / 60, TURNED)
    with pytest.raises(ValueError, match="the body is moving"):
        session.certificate()
    session.solve()
    assert session.certificate().relative >= 0.0
