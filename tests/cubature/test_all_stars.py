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
from snapspace.cubature import element_count
from snapspace.cubature.all_stars import takes_all_stars
from snapspace.cubature.elements import elements_of

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


def test_each_stands_for_its_area_and_nothing_is_trained(
    posed: PosingModel, blended: InterpolationModel
) -> None:
    """Then the energy is that of all triangles, see tests/shells."""
    models = reduced(posed, tets=element_count(posed.problem)), reduced(blended)
    for model, elements in zip(models, (models[0].elastic, models[1].blends), strict=True):
        measures = elements_of(model.problem).measures
        np.testing.assert_array_equal(elements.tets, np.arange(len(measures)))
        np.testing.assert_array_equal(elements.weights, measures)
        assert "held_out" not in model.provenance["cubature"]


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
