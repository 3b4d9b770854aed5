"""Blends of a reduced model, frame by frame."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from snapspace import BlendingSession, InterpolationModel, InterpolationProblem, reduce
from snapspace.mesh import mass_norm

from ..shapes import bar_poses

FloatArray = NDArray[np.float64]
TIGHT = 1e-14  # tolerance at which the shape has converged to the rounding of values
WEIGHTS = np.array([0.2, 0.7, 0.1])


@pytest.fixture
def session(blending_model: InterpolationModel) -> BlendingSession:
    return blending_model.session(tolerance=TIGHT)


def distance(a: FloatArray, b: FloatArray) -> float:
    return float(np.abs(a - b).max())


def mean(session: BlendingSession) -> FloatArray:
    return session.model.problem.tau.reshape(-1, 3)


@pytest.mark.parametrize("weights", [*np.eye(3), WEIGHTS, [0.5, 0.5, 0.0], [0.1, 0.3, 0.6]])
def test_a_frame_is_the_minimiser_that_scipy_finds(session: BlendingSession, weights: Any) -> None:
    quartic = session.model.elastic(weights)
    report = session.blend(weights)
    reference = minimize(
        quartic.value_and_gradient, np.zeros(12), jac=True, method="BFGS", options={"gtol": 1e-10}
    )
    scale = quartic.value(np.zeros(12))
    assert report.value == pytest.approx(reference.fun, rel=1e-9, abs=1e-12 * scale)
    assert session.q == pytest.approx(reference.x, abs=1e-6)


def test_scipy_finds_the_helix_frames(helix_model: InterpolationModel) -> None:
    """Here the path from the mean shape is long and curved."""
    session = helix_model.session(tolerance=TIGHT)
    for w in ([0.5, 0.5], [0.2, 0.8], [0.9, 0.1]):
        report = session.blend(w)
        quartic = helix_model.elastic(w)
        reference = minimize(
            quartic.value_and_gradient, np.zeros(20), jac=True, options={"gtol": 1e-9}
        )
        assert report.value == pytest.approx(reference.fun, rel=1e-8)
        assert session.q == pytest.approx(reference.x, abs=1e-5 * helix_model.coordinate_scale)


def test_the_report_has_the_full_objective_at_the_vertices(session: BlendingSession) -> None:
    report = session.blend(WEIGHTS)
    problem, basis = session.model.problem, session.model.subspace.basis
    value, gradient = problem.value_and_gradient(session.vertices, WEIGHTS)
    assert report.value == pytest.approx(value, rel=1e-10)
    tension = np.linalg.norm(problem.value_and_gradient(session.vertices, np.eye(3)[0])[1])
    assert np.linalg.norm(basis.T @ gradient) < 1e-6 * tension
    assert report.gradient_norm < 1e-6 * tension
    assert 0 < report.iterations <= report.evaluations
    assert report.seconds > 0


@pytest.mark.parametrize("pose", range(3))
def test_one_hot_weights_give_the_pose_as_far_as_the_subspace_holds_it(
    session: BlendingSession, pose: int
) -> None:
    """The reduced minimum is at most about ten times as far as the projection."""
    problem, subspace = session.model.problem, session.model.subspace
    session.blend(np.eye(3)[pose])
    rest = problem.pose_shapes[pose]
    projected = subspace.shape(subspace.coordinates(rest))
    least = mass_norm(subspace.mass, projected - rest)
    size = mass_norm(subspace.mass, rest - subspace.tau)
    found = mass_norm(subspace.mass, session.vertices.reshape(-1) - rest)
    assert least <= found * (1 + 1e-9)
    assert found < 10 * least + 1e-6 * size
    assert found < 1e-3 * size


def test_a_new_session_and_a_reset_one_are_the_mean_shape(session: BlendingSession) -> None:
    assert np.array_equal(session.vertices, mean(session))
    assert np.array_equal(session.weights, np.full(3, 1 / 3))
    session.blend(WEIGHTS)
    assert np.array_equal(session.weights, WEIGHTS)
    assert distance(session.vertices, mean(session)) > 0.1
    session.reset()
    assert np.array_equal(session.vertices, mean(session))
    assert np.array_equal(session.weights, np.full(3, 1 / 3))
    assert session.solve().value == pytest.approx(
        session.model.problem.value_and_gradient(mean(session), session.weights)[0], rel=1e-6
    )
    assert distance(session.vertices, mean(session)) < 1e-3


def test_there_and_back_returns(session: BlendingSession) -> None:
    session.blend(WEIGHTS)
    start = session.vertices
    for share in np.linspace(0, 1, 8):
        session.blend((1 - share) * WEIGHTS + share * np.array([0.0, 0.1, 0.9]))
    assert distance(session.vertices, start) > 0.2
    for share in np.linspace(1, 0, 8):
        session.blend((1 - share) * WEIGHTS + share * np.array([0.0, 0.1, 0.9]))
    assert distance(session.vertices, start) < 1e-6


def test_blending_twice_changes_nothing(session: BlendingSession) -> None:
    session.blend(WEIGHTS)
    once = session.vertices
    report = session.blend(WEIGHTS)
    assert distance(session.vertices, once) < 1e-7
    assert report.iterations <= 2


def test_weights_are_copies(session: BlendingSession) -> None:
    given = WEIGHTS.copy()
    session.blend(given)
    given[:] = [1.0, 0.0, 0.0]
    session.weights[:] = 0.0
    assert np.array_equal(session.weights, WEIGHTS)


WRONG: list[tuple[Any, str]] = [
    ([0.5, 0.5], "InterpolationProblem: 3 poses need 3 weights, got 2"),
    (1.0, "InterpolationProblem: 3 poses need 3 weights, got ()"),
    ([[0.5, 0.5, 0.0]], "InterpolationProblem: 3 poses need 3 weights, got (1, 3)"),
    (["a", "b", "c"], "InterpolationProblem: weights must be 3 numbers, one per pose"),
    ([0.5, math.nan, 0.5], "InterpolationProblem: weight 1 is nan, but it must be finite"),
    ([0.5, 0.5, math.inf], "InterpolationProblem: weight 2 is inf, but it must be finite"),
    ([0.5, 0.5, 0.5], "the weights sum to 1.5, but they must sum to 1; divide them by their sum"),
    ([0.6, 0.6, -0.2], "weight 2 is -0.2, but none may be below 0; InterpolationProblem(ext"),
    ([1.5, 0.0, -0.5], "weight 2 is -0.5, but none may be below 0; InterpolationProblem(ext"),
]


@pytest.mark.parametrize(("weights", "message"), WRONG)
def test_wrong_weights_are_refused_and_change_nothing(
    session: BlendingSession, weights: Any, message: str
) -> None:
    session.blend(WEIGHTS)
    before = session.vertices
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        session.blend(weights)
    assert "\n" not in str(caught.value)
    assert np.array_equal(session.vertices, before)
    assert np.array_equal(session.weights, WEIGHTS)
    session.solve()
    assert distance(session.vertices, before) < 1e-7, "the energy is that of the old weights"


def test_extrapolated_weights_go_beyond_the_pose(session: BlendingSession) -> None:
    """The difference to the mean shape grows, in the direction of the pose."""
    tau, mass = session.model.problem.tau, session.model.subspace.mass
    beyond = np.array([-0.1, 1.2, -0.1])
    session.blend([0.0, 1.0, 0.0])
    pose = session.vertices.reshape(-1) - tau
    report = session.blend(beyond, extrapolate=True)
    further = session.vertices.reshape(-1) - tau
    assert report.converged
    assert report.value == pytest.approx(session.model.value(session.q, beyond), rel=1e-9)
    assert mass_norm(mass, further) > 1.1 * mass_norm(mass, pose)
    with pytest.raises(ValueError, match=re.escape("the weights sum to 1.2")):
        session.blend([0.0, 1.2, 0.0], extrapolate=True)
    assert session.set_parameters(beyond).converged


def test_a_model_of_a_larger_domain_takes_its_weights(blending_model: InterpolationModel) -> None:
    old = blending_model.problem
    problem = InterpolationProblem(
        bar_poses(), material=old.material, extrapolation=0.3, mean_shape=old.tau
    )
    session = reduce(problem, blending_model.subspace).session()
    assert session.blend([-0.1, 1.1, 0.0]).converged
    with pytest.raises(ValueError, match=re.escape("weight 0 is -0.2, but none may be below -0.1")):
        session.blend([-0.2, 1.2, 0.0])


def test_a_model_without_training_data_is_blended_too(
    blending_model: InterpolationModel, session: BlendingSession
) -> None:
    bare = reduce(blending_model.problem, blending_model.subspace)
    assert bare.training_parameters.shape == (0, 3)
    other = bare.session(tolerance=TIGHT)
    assert other.blend(WEIGHTS).iterations > 0
    session.blend(WEIGHTS)
    assert distance(other.vertices, session.vertices) < 1e-6
