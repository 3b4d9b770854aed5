"""Full-space iterations from a frame: nearer to the solution, and without side effects."""

from __future__ import annotations

import time

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    HandleBox,
    Handles,
    InterpolationModel,
    PosingProblem,
    ReducedModel,
    Session,
    SolverOptions,
    StVK,
    interruptible,
    reduce,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.generators import creature_handles
from snapspace.mesh import mass_norm
from snapspace.problem import rotation_matrix

from ..shapes import random_subspace
from ..snapshots.creatures import creature

FloatArray = NDArray[np.float64]
NEVER = 1e-300


@pytest.fixture(params=["posing", "blending"])
def session(
    request: pytest.FixtureRequest, posing_model: ReducedModel, blending_model: InterpolationModel
) -> Session:
    return posing_model.session() if request.param == "posing" else blending_model.session()


def unseen(session: Session, count: int = 8) -> FloatArray:
    return sample(session.model.problem.domain, count, seed=321)


def framed(session: Session, w: FloatArray) -> Session:
    session.reset()
    session.set_parameters(w)
    return session


def full_value(session: Session, shape: FloatArray, w: FloatArray) -> float:
    problem = session.model.problem
    displacement = shape.reshape(-1) - problem.base
    return float(problem.system.value_and_gradient(displacement, problem.inputs(w[None])[0])[0])


def test_a_polished_shape_is_lower_and_nearer_to_the_full_solution(session: Session) -> None:
    problem, mass = session.model.problem, session.model.subspace.mass
    parameters = unseen(session)
    tight = SolverOptions(tolerance=1e-12, max_iterations=5000)
    solved = solve_snapshots(problem, parameters, options=tight)
    left = []
    for w, shape in zip(parameters, solved.shapes, strict=True):
        frame = framed(session, w).vertices.reshape(-1)
        before, value = mass_norm(mass, problem.aligned(frame, shape) - shape), np.inf
        row = []
        for iterations in (5, 20, 60):
            result = session.polish(iterations=iterations, tolerance=NEVER)
            assert result.report.value < min(value, full_value(session, frame, w))
            assert result.report.value == pytest.approx(full_value(session, result.vertices, w))
            value = result.report.value
            after = problem.aligned(result.vertices.reshape(-1), shape) - shape
            row.append(mass_norm(mass, after) / before)
        left.append(row)
    five, twenty, sixty = np.median(left, axis=0)
    assert five < 0.9 and twenty < 0.4 and sixty < 0.05


def test_the_reduced_hessian_in_the_seed_brings_shapes_nearer(session: Session) -> None:
    """Compared with the scalar factor alone, which an inverse of almost zero leaves."""
    problem, subspace = session.model.problem, session.model.subspace
    coarse = core.CoarseSpace(problem.system, np.ascontiguousarray(subspace.basis.T))
    ratios = []
    for w in unseen(session, 48):
        q = framed(session, w).q
        inverse = np.linalg.inv(session._loop.hessian(q))
        solutions = [
            core.polish(
                problem.system,
                coarse,
                np.ascontiguousarray(seed),
                problem.inputs(w[None])[0],
                subspace.shape(q) - problem.base,
                tolerance=NEVER,
                max_iterations=iterations,
                threads=1,
                control=core.SolveControl(),
            ).shape
            for seed, iterations in ((inverse, 10), (1e-30 * inverse, 10), (inverse, 500))
        ]
        two, one, full = problem.registered(np.array(solutions))
        ratios.append(mass_norm(subspace.mass, two - full) / mass_norm(subspace.mass, one - full))
    # a bar between handles is stiff, and the difference is below a tenth
    bound = 1.1 if isinstance(problem, PosingProblem) else 0.8
    assert np.median(ratios) < bound


def test_the_session_stays_as_it_is(session: Session) -> None:
    first, second = unseen(session, 2)
    framed(session, first)
    q, vertices = session.q, session.vertices
    result = session.polish()
    assert result.moved > 0
    np.testing.assert_array_equal(session.q, q)
    np.testing.assert_array_equal(session.vertices, vertices)
    session.set_parameters(second)
    following = session.q
    framed(session, first)
    session.set_parameters(second)
    np.testing.assert_array_equal(session.q, following)


def test_no_iterations_change_nothing(session: Session) -> None:
    framed(session, unseen(session, 1)[0])
    result = session.polish(iterations=0)
    assert result.moved == result.moved_relative == result.moved_most == 0.0
    assert result.report.iterations == 0
    # blends are registered, and bases are free of rigid motions to single precision
    size = session.model.problem.mesh.diagonal
    np.testing.assert_allclose(result.vertices, session.vertices, atol=1e-9 * size)


def test_a_solution_is_not_moved(session: Session) -> None:
    """At rest, and for equal weights, the frame is the full solution."""
    session.reset()
    result = session.polish(tolerance=1e-9)
    assert result.report.converged
    assert result.moved < 1e-5 * session.model.problem.mesh.diagonal


def test_the_distances_are_those_of_the_shapes(posing_model: ReducedModel) -> None:
    session = posing_model.session()
    framed(session, unseen(session, 1)[0])
    result = session.polish()
    mass, difference = posing_model.subspace.mass, result.vertices - session.vertices
    norm = mass_norm(mass, difference.reshape(-1))
    assert result.moved == pytest.approx(norm / np.sqrt(posing_model.problem.mesh.volume))
    assert result.moved_relative == pytest.approx(norm / np.linalg.norm(session.q))
    assert result.moved_most == pytest.approx(np.linalg.norm(difference, axis=1).max())


def test_a_common_motion_of_all_handles_carries_the_polished_shape(
    posing_model: ReducedModel,
) -> None:
    session = posing_model.session()
    session.move("head", euler=(0.3, 0.2, -0.4), translation=(0.2, 0.1, 0.3))
    before = session.polish().vertices
    turn = rotation_matrix(np.array([0.4, -0.8, 1.1]))
    maps = dict(zip(posing_model.problem.handles.names, session._maps, strict=True))
    for handle, world in maps.items():
        session.move_affine(handle, np.column_stack([turn @ world[:, :3], turn @ world[:, 3] + 2]))
    np.testing.assert_allclose(session.polish().vertices, before @ turn.T + 2, atol=1e-5)


def test_a_polish_ends_when_the_tolerance_is_met(session: Session) -> None:
    framed(session, unseen(session, 1)[0])
    result = session.polish(iterations=2000, tolerance=1e-6)
    assert result.report.status == "converged"
    assert result.report.decrement <= 1e-6 * result.report.value
    assert session.polish(iterations=3, tolerance=NEVER).report.status == "max_iterations"


def test_a_frame_that_is_no_minimum_can_be_polished(posing_model: ReducedModel) -> None:
    """Away from minima the reduced Hessian may have negative curvatures; a seed must not."""
    session = posing_model.session(max_iterations=1)
    for w in unseen(session, 4):
        framed(session, 2.0 * w)
        value = full_value(session, session.vertices, 2.0 * w)
        assert session.polish(iterations=5).report.value < value


@pytest.fixture(scope="module")
def far_session() -> Session:
    """A session in a random subspace: a polish takes a second and hundreds of iterations."""
    mesh = creature(5000)
    parts = creature_handles(mesh)
    problem = PosingProblem(
        mesh,
        Handles([parts["feet"], parts["head"]]),
        domain=HandleBox(translation=0.3, angle=0.8),
        material=StVK(),
    )
    session = reduce(problem, random_subspace(mesh, 4), threads=1).session()
    session.pose([0.1, 0.2, -0.1, 0.5, 0.3, -0.6])
    session.polish(iterations=1)
    return session


def test_a_polish_can_be_stopped_and_keeps_the_best_shape(
    far_session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(interruptible, "POLL_SECONDS", 0.02)
    begin = far_session.polish(iterations=0).report.value
    result = far_session.polish(iterations=10**6, tolerance=NEVER, should_stop=lambda: True)
    assert result.report.status == "cancelled" and result.seconds < 0.5
    assert result.report.evaluations > 0 and result.moved > 0
    w = np.array([0.1, 0.2, -0.1, 0.5, 0.3, -0.6])
    value = full_value(far_session, result.vertices, w)
    assert value == pytest.approx(result.report.value) and value < begin


def test_ctrl_c_ends_a_polish_and_the_session_stays_usable(
    far_session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(interruptible, "POLL_SECONDS", 0.02)
    q = far_session.q

    def ctrl_c() -> bool:
        raise KeyboardInterrupt

    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        far_session.polish(iterations=10**6, tolerance=NEVER, should_stop=ctrl_c)
    assert time.perf_counter() - begin < 0.5
    np.testing.assert_array_equal(far_session.q, q)
    assert far_session.polish().moved > 0


def test_a_solve_that_is_cancelled_before_it_begins_returns_its_start(session: Session) -> None:
    problem, subspace = session.model.problem, session.model.subspace
    w = unseen(session, 1)
    q = framed(session, w[0]).q
    control = core.SolveControl()
    control.cancel()
    start = subspace.shape(q) - problem.base
    solution = core.polish(
        problem.system,
        core.CoarseSpace(problem.system, np.ascontiguousarray(subspace.basis.T)),
        np.eye(len(q)),
        problem.inputs(w)[0],
        start,
        tolerance=1e-5,
        max_iterations=10,
        threads=1,
        control=control,
    )
    assert solution.report.status.name == "cancelled" and solution.report.evaluations == 0
    np.testing.assert_array_equal(solution.shape, start)


@pytest.mark.parametrize("options", [{"iterations": -1}, {"tolerance": 0.0}, {"tolerance": np.nan}])
def test_bad_options_are_refused(session: Session, options: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=r"polish: iterations .* and tolerance .* must be pos"):
        session.polish(**options)  # type: ignore[arg-type]
