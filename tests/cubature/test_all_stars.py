"""Surfaces with few neighbourhoods take all of them, and their energy is exact."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from snapspace import (
    ARAP,
    Cubature,
    HandleBox,
    Handles,
    InterpolationModel,
    PosingModel,
    PosingProblem,
    StableNeoHookean,
    reduce,
    sample,
    solve_snapshots,
)
from snapspace.accurate.predicting import FEW_STARS, predicting_stars
from snapspace.cubature import BlendedStars, element_count
from snapspace.cubature.all_stars import takes_all_stars
from snapspace.reduction.full_energy import full_energy

from ..shells.sheets import sphere
from ..shells.strips import WIDE, blended_strips, shell_model, strip_problem


@pytest.fixture(scope="module")
def posed() -> PosingModel:
    return shell_model(ARAP(), varied=True, radius=WIDE)


@pytest.fixture(scope="module")
def blended() -> InterpolationModel:
    return blended_strips(ARAP(radius=WIDE))


def reduced(model: PosingModel | InterpolationModel, **options: Any) -> Any:
    problem = model.problem
    snapshots = solve_snapshots(problem, sample(problem.domain, 16, seed=2), threads=1)
    return reduce(problem, model.subspace, snapshots=snapshots, threads=1, **options)


def test_blends_take_all_if_the_usual_number_is_half_of_them(
    posed: PosingModel, blended: InterpolationModel
) -> None:
    for problem, share in ((posed.problem, 1.0), (blended.problem, 0.5)):
        count = element_count(problem)
        enough = int(np.ceil(share * count))
        assert takes_all_stars(problem, None, enough)
        assert not takes_all_stars(problem, None, enough - 1)
        assert takes_all_stars(problem, count, 1)
        assert not takes_all_stars(problem, count - 1, count)
    assert not takes_all_stars(strip_problem(material=StableNeoHookean()), None, 10**6)


def test_the_energy_of_a_posed_surface_is_exact(posed: PosingModel) -> None:
    model = reduced(posed, tets=element_count(posed.problem))
    assert len(model.elastic.tets) == element_count(posed.problem)
    assert "held_out" not in model.provenance["cubature"]
    q = 0.1 * posed.coordinate_scale * np.random.default_rng(0).normal(size=posed.dimension)
    value, gradient = full_energy(posed.problem, posed.subspace).value_and_gradient(q)
    found, slope = model.elastic.value_and_gradient(q)
    assert found == pytest.approx(value, rel=1e-4)  # rows are in single precision
    np.testing.assert_allclose(slope, gradient, atol=1e-4 * np.abs(gradient).max())


def test_the_energy_of_a_blend_is_exact(blended: InterpolationModel) -> None:
    model = reduced(blended)
    assert len(model.blends.tets) == element_count(blended.problem)
    assert isinstance(model.blends, BlendedStars)
    q = 0.1 * blended.coordinate_scale * np.random.default_rng(1).normal(size=blended.dimension)
    w = np.array([0.2, 0.5, 0.3])
    shape = blended.subspace.tau + blended.subspace.basis @ q
    value, gradient = blended.problem.value_and_gradient(shape, w)
    found, slope = model.blends.value_and_gradient(q, w)
    wanted = blended.subspace.basis.T @ gradient
    assert found == pytest.approx(value, rel=1e-4)
    np.testing.assert_allclose(slope, wanted, atol=1e-4 * np.abs(wanted).max())


def test_fewer_can_be_asked_for(posed: PosingModel) -> None:
    count = element_count(posed.problem) // 3
    model = reduced(posed, tets=count)
    assert isinstance(model.elastic, Cubature) and len(model.elastic.tets) <= count
    assert "held_out" in model.provenance["cubature"]


def test_models_that_only_predict_have_all_of_a_few(posed: PosingModel) -> None:
    assert predicting_stars(posed.problem) == element_count(posed.problem)
    assert predicting_stars(strip_problem(material=StableNeoHookean())) is None, "of hinges"
    ball = sphere(5)
    assert len(ball.vertices) > FEW_STARS
    high = ball.vertices[:, 2]
    many = PosingProblem(
        ball,
        Handles([high < -0.5, high > 0.5]),
        domain=HandleBox(translation=0.1, angle=0.1),
        material=ARAP(),
    )
    assert predicting_stars(many) is None
