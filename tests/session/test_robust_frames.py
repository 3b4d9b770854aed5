"""Any motion of the handles gives a finite frame quickly, and a report of what happened."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel, PosingSession
from snapspace.problem import rotation_matrix

FloatArray = NDArray[np.float64]
STATUSES = {"converged", "max_iterations", "max_evaluations", "line_search_failed", "not_finite"}
MINIMIZERS = st.sampled_from(["newton", "bfgs"])
ANGLES = st.tuples(*[st.floats(-10, 10)] * 3)
#: From zero to the size of the mesh, and to lengths whose fourth power overflows.
SHIFTS = st.tuples(*[st.one_of(st.floats(-3, 3), st.floats(-1e6, 1e6), st.floats())] * 3)
HANDLES = st.sampled_from(["foot", "head", "belly"])
MOTIONS = st.lists(st.tuples(HANDLES, ANGLES, SHIFTS), min_size=1, max_size=5)


@pytest.mark.filterwarnings("ignore:move. euler of")  # any angles
@given(motions=MOTIONS, minimizer=MINIMIZERS, bound=st.sampled_from([1, 2, 20, 500]))
@settings(max_examples=60)
def test_any_motion_ends_soon_with_numbers(
    posing_model: PosingModel,
    motions: list[tuple[str, tuple[float, ...], tuple[float, ...]]],
    minimizer: str,
    bound: int,
) -> None:
    session = posing_model.session(minimizer=minimizer, max_evaluations=bound)
    for handle, euler, translation in motions:
        before = session.q
        try:
            report = session.move(handle, euler=euler, translation=translation)
        except ValueError as error:
            assert f"translation of '{handle}' has [" in str(error)
            assert np.array_equal(session.q, before)
            continue
        assert report.status in STATUSES
        assert report.evaluations <= bound
        assert np.isfinite(session.q).all()
        if report.status != "not_finite":
            assert np.isfinite(report.value) and np.isfinite(report.gradient_norm)
        assert np.isfinite(session.vertices).all()
    session.reset()
    session.max_evaluations = 500
    for _ in range(2):
        report = session.move("head", euler=(0.1, 0.0, 0.2))
    assert report.converged, "the session works as before"
    fresh = posing_model.session()
    fresh.move("head", euler=(0.1, 0.0, 0.2))
    assert session.vertices == pytest.approx(fresh.vertices, abs=1e-2)


@pytest.mark.parametrize("diagonals", [1e2, 1e4, 1e8])
def test_a_session_comes_back_from_far_beyond_the_domain(
    posing_model: PosingModel, diagonals: float
) -> None:
    """This happens after a translation in millimetres on a mesh in metres."""
    near = {"head": ((0.1, 0.0, 0.2), (0.0, 0.1, 0.0))}
    session, fresh = posing_model.session(), posing_model.session()
    fresh.move_all(near)
    far = diagonals * posing_model.problem.mesh.diagonal
    session.move("head", translation=(0.0, 0.0, far))
    report = session.move_all(near)
    assert report.converged
    assert report.start == "sample", "the last frame is no start: it is far from any solution"
    tolerance = 1e-3 * posing_model.problem.mesh.diagonal
    assert session.vertices == pytest.approx(fresh.vertices, abs=tolerance)


@pytest.mark.parametrize("minimizer", ["newton", "bfgs"])
@pytest.mark.parametrize("axis", range(3))
def test_a_flip_converges_to_a_minimum(
    posing_model: PosingModel, minimizer: str, axis: int
) -> None:
    """A half turn is symmetric: from rest, both directions are equally far."""
    session = posing_model.session(minimizer=minimizer, tolerance=1e-10)
    for angle in (np.pi, 0.0, -np.pi, np.pi):
        session.move("head", euler=np.eye(3)[axis] * angle)
        assert session.solve().converged
        curvature = np.linalg.eigvalsh(session._loop.hessian(session.q))
        assert curvature[0] > -1e-6 * curvature[-1]


@given(seed=st.integers(0, 1000), minimizer=MINIMIZERS)
@settings(max_examples=15)
def test_a_slow_drag_there_and_back_returns_or_says_so(
    posing_model: PosingModel, seed: int, minimizer: str
) -> None:
    """The path includes rotations of twice the sampled range."""
    session = posing_model.session(minimizer=minimizer, tolerance=1e-12)
    bounds = posing_model.problem.domain.half_widths
    corners = np.random.default_rng(seed).uniform(-2 * bounds, 2 * bounds, (3, len(bounds)))
    share = np.linspace(0, 1, 25)[:, None]
    path = np.concatenate([a + share * (b - a) for a, b in pairwise([0 * bounds, *corners])])
    session.pose(0.3 * bounds)
    session.pose(path[0])
    start, value = session.vertices, session.solve().value
    for w in [*path, *path[::-1]]:
        report = session.pose(w)
        assert report.status in ("converged", "line_search_failed")
    away = np.abs(session.vertices - start).max() / posing_model.problem.mesh.diagonal
    if away > 1e-4:
        anew = session.solve_anew()
        assert anew.start != "last frame" and anew.value < report.value
        assert anew.value <= value * (1 + 1e-6) + 1e-9


def test_a_whole_turn_ends_at_rest(posing_model: PosingModel) -> None:
    """A bar cannot stay twisted in this subspace, and solving anew finds no lower minimum."""
    session = posing_model.session(tolerance=1e-10)
    for angle in np.linspace(0, 2 * np.pi, 60):
        session.move("head", euler=(angle, 0, 0))
    report = session.solve_anew()
    assert report.start == "last frame" and report.value == pytest.approx(0.0, abs=1e-9)
    assert session.vertices == pytest.approx(posing_model.problem.mesh.vertices, abs=1e-3)


def outside_after(session: PosingSession, euler: tuple[float, float, float]) -> tuple[str, ...]:
    session.move("head", euler=euler)
    return session.outside


@pytest.mark.filterwarnings("ignore:move. euler of")  # any angles
def test_handles_outside_of_the_sampled_box_are_reported(posing_model: PosingModel) -> None:
    session = posing_model.session()
    domain = posing_model.problem.domain
    angle = domain.half_widths[3]
    assert session.outside == ()
    assert outside_after(session, (0.99 * angle, 0, -0.99 * angle)) == ()
    assert outside_after(session, (1.01 * angle, 0, 0)) == ("head",)
    assert outside_after(session, (0.5 * angle + 2 * np.pi, 0, 0)) == (), (
        "a whole turn changes nothing"
    )
    assert outside_after(session, (np.pi, np.pi, np.pi)) == (), "three half turns are none"
    session.pose(0.9 * domain.half_widths)
    assert session.outside == ()
    session.pose(1.1 * domain.half_widths)
    assert session.outside == ("head", "belly")
    session.reset()
    session.move_affine("head", np.column_stack([np.diag([1.0, 1.5, 1.0]), np.zeros(3)]))
    assert session.outside == ("head",), "no affine map was sampled"
    session.reset()
    common = np.column_stack([rotation_matrix((1.0, 2.0, 3.0)), [50.0, 0.0, 0.0]])
    for handle in ("foot", "head", "belly"):
        session.move_affine(handle, common)
    assert session.outside == (), "relative to the first handle nothing has moved"


def test_weights_beyond_the_simplex_are_reported(blending_model: InterpolationModel) -> None:
    session = blending_model.session()
    session.blend([0.2, 0.8, 0.0])
    assert session.outside == ()
    session.blend([-0.1, 1.1, 0.0], extrapolate=True)
    assert session.outside == (blending_model.problem.poses.names[0],)
    session.reset()
    assert session.outside == ()


def test_huge_weights_change_nothing(blending_model: InterpolationModel) -> None:
    session = blending_model.session()
    session.blend([0.2, 0.8, 0.0])
    before = session.vertices
    report = session.blend([1e308, -1e308, 1.0], extrapolate=True)
    assert report.status in ("not_finite", "unbounded")
    assert np.array_equal(session.vertices, before)
    assert np.array_equal(session.weights, [0.2, 0.8, 0.0])


def test_a_blend_reports_where_it_started(blending_model: InterpolationModel) -> None:
    session = blending_model.session()
    session.blend([0.5, 0.5, 0.0])
    assert session.blend([0.499, 0.501, 0.0]).start == "last frame"
    assert session.blend([0.0, 0.02, 0.98]).start == "sample"
    assert session.solve_anew().start == "last frame"
