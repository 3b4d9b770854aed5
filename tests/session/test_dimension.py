"""The dimension changes during a session."""

from __future__ import annotations

import re

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel

FloatArray = NDArray[np.float64]
TIGHT = 1e-13


def bent(model: PosingModel) -> FloatArray:
    return 0.6 * model.problem.domain.half_widths


@pytest.mark.parametrize("dimension", [1, 2, 7, 13, 19, 20])
@pytest.mark.parametrize("minimizer", ["newton", "bfgs"])
def test_a_frame_is_that_of_the_leading_model(
    posing_model: PosingModel, dimension: int, minimizer: str
) -> None:
    small = posing_model.leading(dimension).session(tolerance=TIGHT, minimizer=minimizer)
    session = posing_model.session(tolerance=TIGHT, minimizer=minimizer)
    session.dimension = dimension
    assert session.q.shape == (dimension,)
    a, b = small.pose(bent(posing_model)), session.pose(bent(posing_model))
    assert a.converged and b.converged
    assert b.value == pytest.approx(a.value, rel=1e-11)
    assert session.vertices == pytest.approx(small.vertices, abs=1e-7)


def test_the_dimension_changes_while_handles_stay(posing_model: PosingModel) -> None:
    session = posing_model.session(tolerance=TIGHT)
    values = {d: [] for d in (20, 12, 5)}
    session.pose(bent(posing_model))
    full = session.vertices
    for dimension in (20, 5, 12, 20, 12, 5, 20):
        session.dimension = dimension
        report = session.solve()
        assert report.converged
        values[dimension].append(report.value)
    for value in values.values():
        assert value == pytest.approx([value[0]] * len(value), rel=1e-10)
    assert values[20][0] < values[12][0] < values[5][0], "more coordinates, less energy"
    assert session.vertices == pytest.approx(full, abs=1e-6)


def test_the_leading_coordinates_stay_and_added_ones_are_zero(
    posing_model: PosingModel,
) -> None:
    session = posing_model.session()
    session.pose(bent(posing_model))
    q = session.q
    session.dimension = 8
    assert np.array_equal(session.q, q[:8])
    session.dimension = 11
    assert np.array_equal(session.q, [*q[:8], 0.0, 0.0, 0.0])
    session.reset()
    assert session.dimension == 11 and np.array_equal(session.q, np.zeros(11))
    assert np.array_equal(session.vertices, posing_model.problem.mesh.vertices)


@pytest.mark.parametrize("dimension", [1, 5, 12])
def test_blends_in_fewer_coordinates(blending_model: InterpolationModel, dimension: int) -> None:
    weights = [0.1, 0.7, 0.2]
    small = blending_model.leading(dimension).session(tolerance=TIGHT)
    session = blending_model.session(tolerance=TIGHT)
    session.blend([0.3, 0.3, 0.4])
    session.dimension = dimension
    small.blend([0.3, 0.3, 0.4])
    a, b = small.blend(weights), session.blend(weights)
    assert b.value == pytest.approx(a.value, rel=1e-10)
    assert session.vertices == pytest.approx(small.vertices, abs=1e-6)
    session.dimension = 12
    session.solve()
    fresh = blending_model.session(tolerance=TIGHT)
    fresh.blend(weights)
    assert session.vertices == pytest.approx(fresh.vertices, abs=1e-6), "the weights stayed"


@pytest.mark.parametrize("dimension", [0, -3, 21])
def test_a_dimension_that_the_model_does_not_have_is_refused(
    posing_model: PosingModel, dimension: int
) -> None:
    session = posing_model.session()
    message = f"Session: dimension {dimension} is not between 1 and 20; give a number up to that"
    with pytest.raises(ValueError, match=re.escape(message)):
        session.dimension = dimension
    assert session.dimension == 20
