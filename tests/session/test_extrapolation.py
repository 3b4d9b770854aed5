"""Blends beyond the poses: where a minimum is certain, sessions find it."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    BlendingSession,
    InterpolationModel,
    InterpolationProblem,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.generators import lizard_poses

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def model() -> InterpolationModel:
    """Three poses of a small lizard, of the default material."""
    problem = InterpolationProblem(lizard_poses(3, 600, bend=0.6))
    samples = sample(problem.domain, 24, method="blends")
    snapshots = solve_snapshots(problem, samples, threads=1)
    subspace = snapshot_pca(snapshots, dimension=12)
    return reduce(problem, subspace, snapshots=snapshots, threads=1)


@pytest.fixture
def session(model: InterpolationModel) -> BlendingSession:
    return model.session(tolerance=1e-12)


def test_the_reduced_energy_has_a_larger_range_than_that_of_all_tets(
    model: InterpolationModel,
) -> None:
    reduced, full = model.certain_range, model.problem.certain_range
    assert reduced is not None and full is not None
    assert (reduced.limits()[:, 0] <= full.limits()[:, 0] + 1e-9).all()
    assert (reduced.limits()[:, 1] >= full.limits()[:, 1] - 1e-9).all()
    chosen = model.problem.poses.tets[model.blends.tets]  # type: ignore[union-attr]
    assert len(chosen) < len(model.problem.poses.tets)
    assert model.leading(5).certain_range.limits() == pytest.approx(reduced.limits())  # type: ignore[union-attr]


def ends(model: InterpolationModel) -> list[FloatArray]:
    """Ends of the certain range from the centre, towards and away from each pose."""
    certain, center = model.certain_range, model.problem.domain.center
    assert certain is not None
    directions = [sign * (alone - center) for alone in np.eye(3) for sign in (1, -1)]
    return [center + certain.reach(center + direction) * direction for direction in directions]


@pytest.mark.parametrize("share", [0.4, 0.95])
def test_solves_within_the_range_find_one_minimum_from_several_starts(
    model: InterpolationModel, share: float
) -> None:
    center, rng = model.problem.domain.center, np.random.default_rng(7)
    for end in ends(model):
        w = center + share * (end - center)
        energy = model.elastic(w)
        found = []
        for size in (0.0, 0.5, 1.0):  # the poses are 0.2 from the mean shape
            session = model.session(tolerance=1e-10, minimizer="newton")
            away = rng.standard_normal(model.dimension)
            session.put(w, size * model.coordinate_scale * away / np.linalg.norm(away))
            assert session.solve().converged
            assert session.certain
            assert np.linalg.eigvalsh(energy.hessian(session.q))[0] > 0
            found.append(session.q)
        assert np.abs(np.array(found) - found[0]).max() < 1e-4 * model.coordinate_scale


def test_full_solves_find_minima_within_the_range_and_fall_without_bound_not_far_beyond() -> None:
    """The bound from single tets is nearly sharp: in the full space thin limbs collapse first."""
    problem = InterpolationProblem(lizard_poses(3, 600), extrapolation=60.0)
    certain, center = problem.certain_range, problem.domain.center
    assert certain is not None
    directions = [sign * (alone - center) for alone in np.eye(3) for sign in (1, -1)]
    weights = [
        center + share * certain.reach(center + direction) * direction
        for share in (0.95, 1.5)
        for direction in directions
    ]
    converged = solve_snapshots(problem, np.array(weights), threads=1).converged
    assert converged[:6].all()
    assert not converged[6:].any()


def test_the_energy_grows_far_away_within_the_range(model: InterpolationModel) -> None:
    """The energy grows along every direction tried, which is why there is a minimum."""
    center, rng = model.problem.domain.center, np.random.default_rng(3)
    for end in ends(model):
        energy = model.elastic(center + 0.98 * (end - center))
        for direction in rng.standard_normal((10, model.dimension)):
            far = 1e3 * model.coordinate_scale * direction / np.linalg.norm(direction)
            assert energy.value(far) > energy.value(np.zeros(model.dimension))


def test_the_session_reports_weights_outside_the_range(
    model: InterpolationModel, session: BlendingSession
) -> None:
    center = model.problem.domain.center
    assert session.certain
    for end in ends(model):
        session.reset()
        assert session.reach(end) == pytest.approx(1.0)
        for share, certain in ((0.9, True), (1.05, False)):
            w = center + share * (end - center)
            session.put(w, np.zeros(model.dimension))
            assert session.certain is certain
            assert session.outside, "these were not sampled"
    assert session.reach(np.eye(3)[0]) == 0.0, "from a start outside nothing is certain"


def test_without_a_range_only_weights_that_are_not_negative_are_certain(
    blending_model: InterpolationModel,
) -> None:
    """St.Venant-Kirchhoff has no range that is cheap to test."""
    session = blending_model.session()
    assert blending_model.certain_range is None
    session.blend([0.2, 0.8, 0.0])
    assert session.certain is True
    session.blend([-0.1, 0.6, 0.5], extrapolate=True)
    assert session.certain is None
    assert session.reach([0.0, 1.0, 0.0]) is None


WRONG: list[tuple[Any, str]] = [
    ([0.5, 0.5], "3 poses need 3 weights, got 2"),
    ([2.0, 0.0, 0.0], "the weights sum to 2"),
    ([np.nan, 1.0, 0.0], "weight 0 is nan"),
]


@pytest.mark.parametrize(("weights", "message"), WRONG)
def test_wrong_weights_are_refused(session: BlendingSession, weights: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        session.reach(weights)
