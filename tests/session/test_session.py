"""Poses of a reduced model, frame by frame."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from snapspace import ReducedModel, Session
from snapspace.problem import affine_offset, rotation_matrix

from ..shapes import random_rotation

FloatArray = NDArray[np.float64]
TIGHT = 1e-14  # tolerance at which the shape has converged to the rounding of values


@pytest.fixture
def session(posing_model: ReducedModel) -> Session:
    return posing_model.session(tolerance=TIGHT)


def rest(session: Session) -> FloatArray:
    return session.model.problem.mesh.vertices


def parameters(session: Session, share: float = 0.7) -> FloatArray:
    """Parameters of a pose of all moving handles, well inside the domain."""
    half_widths = session.model.problem.domain.half_widths
    return np.random.default_rng(1).uniform(-share, share, len(half_widths)) * half_widths


def distance(a: FloatArray, b: FloatArray) -> float:
    return float(np.abs(a - b).max())


@pytest.mark.parametrize("seed", range(3))
def test_a_frame_is_the_minimiser_that_scipy_finds(session: Session, seed: int) -> None:
    model = session.model
    half_widths = model.problem.domain.half_widths
    w = np.random.default_rng(seed).uniform(-half_widths, half_widths)
    report = session.pose(w)
    offsets = model.problem.offsets(w)
    handles = model.handles
    pull = np.einsum("hik,hk->i", handles.L, offsets.reshape(3, 12))

    def objective(q: FloatArray) -> tuple[float, FloatArray]:
        elastic, gradient = model.elastic.value_and_gradient(q)
        return elastic + handles.value(q, offsets), gradient + 2 * (handles.K @ q - pull)

    reference = minimize(objective, np.zeros(20), jac=True, method="BFGS", options={"gtol": 1e-9})
    assert report.converged
    assert report.value == pytest.approx(reference.fun, rel=1e-10)
    assert session.q == pytest.approx(reference.x, abs=1e-6)


def test_the_report_has_the_full_objective_at_the_vertices(session: Session) -> None:
    w = parameters(session)
    report = session.pose(w)
    value, gradient = session.model.problem.value_and_gradient(session.vertices, w)
    assert report.status == "converged" and report.converged
    assert report.value == pytest.approx(value, rel=1e-11)
    reduced = session.model.subspace.basis.T @ gradient
    assert report.gradient_norm == pytest.approx(np.linalg.norm(reduced), rel=1e-3, abs=1e-9)
    assert report.gradient_norm < 1e-5 < np.linalg.norm(gradient)
    assert 0 < report.iterations <= report.evaluations
    assert report.seconds > 0


def test_a_new_session_and_a_reset_one_are_exactly_at_rest(session: Session) -> None:
    assert np.array_equal(session.vertices, rest(session))
    session.move("foot", euler=(0.1, 0.2, 0.3), translation=(1, 2, 3))
    session.move("head", euler=(0, 0.5, 0))
    assert distance(session.vertices, rest(session)) > 0.1
    session.reset()
    assert np.array_equal(session.vertices, rest(session))
    report = session.solve()
    assert (report.iterations, report.value) == (0, 0.0)
    assert np.array_equal(session.vertices, rest(session))


def test_a_moved_handle_follows_and_the_fixed_one_stays(session: Session) -> None:
    """Handles of stiffness 100 miss their targets by a few percent of the motion."""
    problem = session.model.problem
    session.move("head", euler=(0, 0, 0.4), translation=(0.1, 0.2, 0.3))
    head, c = problem.handles["head"].vertices, problem.centroids[1]
    target = (rest(session)[head] - c) @ rotation_matrix((0, 0, 0.4)).T + c + [0.1, 0.2, 0.3]
    motion = distance(target, rest(session)[head])
    assert distance(session.vertices[head], target) < 0.1 * motion
    foot = problem.handles["foot"].vertices
    assert distance(session.vertices[foot], rest(session)[foot]) < 0.1 * motion


def test_a_motion_is_absolute(session: Session) -> None:
    motion = {"euler": (0.1, -0.2, 0.5), "translation": (0.1, 0.2, -0.3)}
    session.move("head", **motion)
    once = session.vertices
    report = session.move("head", **motion)
    assert distance(session.vertices, once) < 1e-6
    assert report.iterations <= 2


def test_dragging_there_and_back_returns(session: Session) -> None:
    session.move("head", euler=(0, 0, 0.3))
    start = session.vertices
    for step in np.linspace(0, 1, 8):
        session.move("head", euler=(0.5 * step, 0, 0.3), translation=(0, 0, 0.6 * step))
    assert distance(session.vertices, start) > 0.3
    for step in np.linspace(1, 0, 8):
        session.move("head", euler=(0.5 * step, 0, 0.3), translation=(0, 0, 0.6 * step))
    assert distance(session.vertices, start) < 1e-6


def test_dragging_back_to_rest_returns_to_rest(session: Session) -> None:
    for step in (0.2, 0.6, 0.3, 0.0):
        session.move("head", euler=(step, -step, step), translation=(step, 0, 0))
    assert distance(session.vertices, rest(session)) < 1e-6


def test_a_pose_equals_the_moves_of_its_handles(
    posing_model: ReducedModel, session: Session
) -> None:
    w = parameters(session)
    session.pose(w)
    moves = posing_model.session(tolerance=TIGHT)
    for handle, motion in zip(("head", "belly"), w.reshape(2, 6), strict=True):
        moves.move(handle, translation=motion[:3], euler=motion[3:])
    assert distance(session.vertices, moves.vertices) < 1e-6


def test_a_pose_puts_the_fixed_handle_back(posing_model: ReducedModel, session: Session) -> None:
    w = parameters(session)
    session.move("foot", euler=(0.3, 0, 0), translation=(5, 0, 0))
    session.pose(w)
    fresh = posing_model.session(tolerance=TIGHT)
    fresh.pose(w)
    assert distance(session.vertices, fresh.vertices) < 1e-6


def test_a_rigid_matrix_equals_a_move(posing_model: ReducedModel, session: Session) -> None:
    euler, t = (0.2, -0.3, 0.4), np.array([0.1, 0.2, 0.3])
    session.move("head", euler=euler, translation=t)
    R, c = rotation_matrix(euler), posing_model.problem.centroids[1]
    by_matrix = posing_model.session(tolerance=TIGHT)
    by_matrix.move_affine("head", np.column_stack([R, c + t - R @ c]))
    assert distance(session.vertices, by_matrix.vertices) < 1e-6


def test_an_affine_map_stretches_a_handle(session: Session) -> None:
    problem = session.model.problem
    matrix = np.column_stack([np.diag([1.0, 1.5, 1.0]), np.zeros(3)])
    report = session.move_affine("head", matrix)
    offsets = np.zeros((3, 3, 4))
    offsets[1, 1, 1], offsets[1, 1, 3] = 0.5, 0.5 * problem.centroids[1][1]
    elastic = problem.energy.value(session.vertices)
    handles = problem.handle_energy(session.vertices, offsets)
    assert report.value == pytest.approx(elastic + handles, rel=1e-10)


def test_moving_the_first_handle_moves_all_others_relative_to_it(
    posing_model: ReducedModel, session: Session
) -> None:
    """The first handle is the frame of reference, and its motion carries the shape along. The
    other handles stay where they are, so they move back in that frame.
    """
    problem = posing_model.problem
    R, t = rotation_matrix((0.1, -0.2, 0.3)), np.array([0.2, -0.1, 0.3])
    matrix = np.column_stack([R, t])
    report = session.move_affine("foot", matrix)
    backwards = posing_model.session(tolerance=TIGHT)
    for handle in ("head", "belly"):
        backwards.move_affine(handle, np.column_stack([R.T, -R.T @ t]))
    assert distance(session.vertices, backwards.vertices @ R.T + t) < 1e-6

    offsets = np.zeros((3, 3, 4))
    offsets[0] = affine_offset(matrix, problem.centroids[0])
    elastic = problem.energy.value(session.vertices)
    handles = problem.handle_energy(session.vertices, offsets)
    assert report.value == pytest.approx(elastic + handles, rel=1e-10)


def test_a_common_rigid_motion_of_all_handles_moves_the_rest_shape(session: Session) -> None:
    R, t = random_rotation(), np.array([3.0, -1.0, 2.0])
    matrix = np.column_stack([R, t])
    for handle in ("head", "foot", "belly"):
        session.move_affine(handle, matrix)
    assert distance(session.vertices, rest(session) @ R.T + t) < 1e-8


def test_a_common_rigid_motion_of_a_pose_moves_the_pose(session: Session) -> None:
    problem, w = session.model.problem, parameters(session)
    session.pose(w)
    posed = session.vertices
    R, t = random_rotation(), np.array([3.0, -1.0, 2.0])
    motions = np.vstack([np.zeros(6), w.reshape(2, 6)])
    for handle, c, motion in zip(problem.handles, problem.centroids, motions, strict=True):
        Q = rotation_matrix(motion[3:])
        world = np.column_stack([R @ Q, R @ (c + motion[:3] - Q @ c) + t])
        session.move_affine(handle.name, world)
    assert distance(session.vertices, posed @ R.T + t) < 1e-6


def test_a_warm_start_needs_fewer_iterations_than_the_rest_shape(
    posing_model: ReducedModel,
) -> None:
    """The sessions have the default tolerance, as live sessions do."""
    w = parameters(posing_model.session())
    warm, cold = [], []
    for direction in np.random.default_rng(2).normal(size=(8, len(w))):
        near = w + 0.002 * direction
        session = posing_model.session()
        cold.append(session.pose(near).iterations)
        session.reset()
        session.pose(w)
        warm.append(session.pose(near).iterations)
    assert np.mean(warm) < 0.7 * np.mean(cold), (warm, cold)


def test_frames_do_not_depend_on_the_path_of_the_drag(session: Session) -> None:
    w = parameters(session)
    session.pose(w)
    direct = session.vertices
    session.pose(-w)
    session.pose(w)
    assert distance(session.vertices, direct) < 1e-6


def test_the_same_drag_gives_bitwise_the_same_frames(posing_model: ReducedModel) -> None:
    frames = []
    for _ in range(2):
        session = posing_model.session()
        session.move("head", euler=(0.3, 0.2, 0.1))
        session.move("belly", translation=(0, 0, 0.2))
        frames.append(session.vertices)
    assert np.array_equal(*frames)


def test_an_exhausted_budget_is_reported(posing_model: ReducedModel) -> None:
    session = posing_model.session(max_iterations=1)
    report = session.pose(parameters(session))
    assert report.status == "max_iterations" and not report.converged
    for _ in range(100):
        if (report := session.solve()).converged:
            break
    assert report.converged, "further solves converge"


def test_moving_all_handles_at_once_equals_moving_them_one_by_one(
    posing_model: ReducedModel,
) -> None:
    names = posing_model.problem.handles.names[1:]
    motions = {name: ((0.1 * k, -0.2, 0.05), (0.02, 0.03 * k, 0.0)) for k, name in enumerate(names)}
    together, one_by_one = (
        posing_model.session(tolerance=1e-12),
        posing_model.session(tolerance=1e-12),
    )
    assert together.move_all(motions).converged
    for name, (euler, translation) in motions.items():
        one_by_one.move(name, euler=euler, translation=translation)
    np.testing.assert_allclose(together.vertices, one_by_one.vertices, atol=1e-6)


def test_if_one_of_several_motions_is_refused_none_is_applied(posing_model: ReducedModel) -> None:
    session = posing_model.session()
    first = posing_model.problem.handles.names[1]
    with pytest.raises(ValueError, match="no handle 'wing'"):
        session.move_all({first: ((0, 0, 0.3), (0, 0, 0)), "wing": ((0, 0, 0), (0, 0, 0))})
    assert session.solve().value == pytest.approx(0.0, abs=1e-20)
    np.testing.assert_array_equal(session.vertices, posing_model.problem.mesh.vertices)
