"""Drags along straight lines: each frame starts where the last three frames lead."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import BlendingSession, InterpolationModel, InterpolationProblem, PosingModel
from snapspace.generators import lizard_poses

from ..conftest import interpolation_model

FloatArray = NDArray[np.float64]
FIRST, LAST, ASIDE = np.array([0.9, 0.1, 0.0]), np.array([0.1, 0.9, 0.0]), np.array([-0.5, -0.5, 1])
SHARES = np.linspace(0.0, 1.0, 81)


@pytest.fixture(scope="module")
def lizards() -> InterpolationModel:
    return interpolation_model(InterpolationProblem(lizard_poses(3, 600, seed=3)), 24, 12)


def blend(share: float, aside: float = 0.0) -> FloatArray:
    weights: FloatArray = (1.0 - share) * FIRST + share * LAST + aside * ASIDE
    return weights


def evaluations(session: BlendingSession, path: Iterable[FloatArray]) -> float:
    """The mean number of evaluations of the frames after the first four."""
    counts = [session.blend(weights).evaluations for weights in path]
    return float(np.mean(counts[4:]))


def test_a_straight_drag_takes_fewer_evaluations_than_a_trembling_one(
    lizards: InterpolationModel,
) -> None:
    """Steps of both have nearly the same length, but no three trembling frames are on a line."""
    straight = evaluations(lizards.session(), [blend(share) for share in SHARES])
    trembling = [blend(share, 0.002 * (k % 2)) for k, share in enumerate(SHARES)]
    assert straight < 0.75 * evaluations(lizards.session(), trembling)


def test_steps_of_uneven_lengths_are_extrapolated_too(lizards: InterpolationModel) -> None:
    """Speeds vary by a half, as of a hand; that costs at most a quarter more evaluations."""
    uneven = SHARES + 0.25 * (SHARES[1] - SHARES[0]) * np.sin(2.5 * np.arange(len(SHARES)))
    even = evaluations(lizards.session(), [blend(share) for share in SHARES])
    assert evaluations(lizards.session(), [blend(share) for share in uneven]) < 1.25 * even + 0.5


@pytest.mark.parametrize(
    "then",
    [blend(0.2), blend(0.6, 0.05), np.array([0.0, 0.0, 1.0])],
    ids=["back", "aside", "far"],
)
def test_a_drag_does_not_change_the_frame_after_it(
    lizards: InterpolationModel, then: FloatArray
) -> None:
    session, fresh = lizards.session(tolerance=1e-12), lizards.session(tolerance=1e-12)
    for share in SHARES[:40]:
        session.blend(blend(share))
    session.blend(then)
    fresh.blend(then)
    apart = np.linalg.norm(session.vertices - fresh.vertices, axis=1).max()
    assert apart < 1e-5 * lizards.problem.mesh.diagonal


def test_a_put_shape_is_where_the_solve_starts(lizards: InterpolationModel) -> None:
    """Given coordinates are not a frame of the drag, so nothing is added to them."""
    session, other = lizards.session(), lizards.session()
    for share in SHARES[:10]:
        session.blend(blend(share))
    elsewhere = session.q * 0.5
    for one in (session, other):
        one.put(blend(SHARES[9]), elsewhere)
        one.blend(blend(SHARES[9]))
    assert session.q == pytest.approx(other.q, abs=1e-6 * lizards.coordinate_scale)


def test_fewer_dimensions_begin_a_new_drag(lizards: InterpolationModel) -> None:
    """Frames of more dimensions are forgotten, and the next one is that of a new session."""
    session, fresh = lizards.session(tolerance=1e-12), lizards.session(tolerance=1e-12)
    for share in SHARES[:10]:
        session.blend(blend(share))
    for one in (session, fresh):
        one.dimension = 6
        one.blend(blend(SHARES[10]))
    assert session.q == pytest.approx(fresh.q, abs=1e-5 * lizards.coordinate_scale)


def pose_evaluations(model: PosingModel, path: Iterable[FloatArray]) -> float:
    """The mean number of evaluations of the frames after the first four."""
    session = model.session(tolerance=1e-12)
    return float(np.mean([session.pose(motion).evaluations for motion in path][4:]))


def motions(model: PosingModel, tremble: float = 0.0) -> list[FloatArray]:
    """Motions from one end of the box to the other; every second one may be off the line."""
    to = 0.8 * model.problem.domain.half_widths
    aside = tremble * to * (np.arange(len(to)) % 2)
    return [(2.0 * share - 1.0) * to + (k % 2) * aside for k, share in enumerate(SHARES)]


def test_a_straight_drag_of_a_handle_takes_fewer_evaluations_than_a_trembling_one(
    posing_model: PosingModel,
) -> None:
    straight = pose_evaluations(posing_model, motions(posing_model))
    assert straight < 0.75 * pose_evaluations(posing_model, motions(posing_model, 0.01))


def test_a_drag_of_a_handle_ends_where_a_jump_does(posing_model: PosingModel) -> None:
    dragged, jumped = posing_model.session(tolerance=1e-12), posing_model.session(tolerance=1e-12)
    path = motions(posing_model)
    for motion in path:
        dragged.pose(motion)
    jumped.pose(path[-1])
    apart = np.linalg.norm(dragged.vertices - jumped.vertices, axis=1).max()
    assert apart < 1e-5 * posing_model.problem.mesh.diagonal


def test_a_drag_leaves_nothing_for_a_jump(cubature_model: PosingModel) -> None:
    """BFGS keeps what a drag taught it for the drag's next frame only."""
    session, fresh = cubature_model.session(), cubature_model.session()
    path = motions(cubature_model)
    for motion in path:
        session.pose(motion)
    session.reset()
    after, anew = session.pose(path[0]), fresh.pose(path[0])
    assert after.evaluations == anew.evaluations
    np.testing.assert_array_equal(session.q, fresh.q)
