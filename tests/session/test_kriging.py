"""Kriging: exact where it must be, smooth where values are not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace.session.kriging import Kriging

FloatArray = NDArray[np.float64]


def points(count: int = 40, size: int = 3, seed: int = 0) -> FloatArray:
    return np.random.default_rng(seed).uniform(-1.0, 1.0, (count, size))


def predicted(kriging: Kriging, weights: FloatArray, point: FloatArray) -> FloatArray:
    return kriging.row(point, kriging.distances(point)) @ weights


@given(nugget=st.floats(1e-8, 10.0), scale=st.sampled_from([1e-3, 1.0, 1e4]))
def test_linear_functions_are_exact_everywhere(nugget: float, scale: float) -> None:
    x = scale * points()
    kriging = Kriging(x)
    slope = np.array([1.0, -2.0, 0.5]) / scale
    weights = kriging.fitted((x @ slope + 3.0)[:, None], np.full(len(x), nugget))
    for at in (x[3], scale * np.array([0.2, 0.1, -0.3]), scale * np.array([50.0, 0.0, -9.0])):
        assert predicted(kriging, weights, at) == pytest.approx(at @ slope + 3.0, rel=1e-6)


def test_a_value_without_a_nugget_is_returned_and_others_are_smoothed() -> None:
    x = points()
    values = np.random.default_rng(1).normal(size=(len(x), 2))
    nugget = np.full(len(x), 0.1)
    nugget[5] = 1e-10
    kriging = Kriging(x)
    weights = kriging.fitted(values, nugget)
    misses = np.array([predicted(kriging, weights, p) for p in x]) - values
    assert misses[5] == pytest.approx(0.0, abs=1e-7)
    assert np.abs(misses[np.arange(len(x)) != 5]).mean() > 0.1


def test_repeated_points_count_as_their_mean() -> None:
    x = points()
    values = np.random.default_rng(2).normal(size=(len(x), 1))
    kriging = Kriging(np.vstack([x, x]))
    split = np.vstack([values + 0.3, values - 0.3])
    twice = np.vstack([values, values])
    nugget = np.full(2 * len(x), 1e-3)
    at = np.array([0.1, 0.4, -0.2])
    expected = predicted(kriging, kriging.fitted(twice, nugget), at)
    assert predicted(kriging, kriging.fitted(split, nugget), at) == pytest.approx(expected)


def test_smooth_functions_converge_with_the_number_of_samples() -> None:
    def function(x: FloatArray) -> FloatArray:
        return np.sin(2.0 * x[:, :1]) * np.cos(x[:, 1:2]) + x[:, 2:] ** 2

    at, errors = points(50, seed=7) * 0.8, []
    for count in (20, 80, 320):
        x = points(count, seed=3)
        kriging = Kriging(x)
        weights = kriging.fitted(function(x), np.full(count, 1e-8))
        found = np.array([predicted(kriging, weights, p) for p in at])
        errors.append(np.abs(found - function(at)).mean())
    assert errors[1] < 0.4 * errors[0] and errors[2] < 0.4 * errors[1]


def test_directions_without_extent_have_no_trend() -> None:
    flat = points()
    flat[:, 2] = 0.7
    assert Kriging(points()).trend_size == 4
    kriging = Kriging(flat)
    assert kriging.trend_size == 3
    weights = kriging.fitted(flat[:, :1], np.full(len(flat), 1e-4))
    assert predicted(kriging, weights, np.array([0.3, 0.2, 0.7])) == pytest.approx(0.3, abs=1e-8)


def test_distances_are_euclidean() -> None:
    x, at = points(), np.array([0.3, -0.6, 0.1])
    expected = np.linalg.norm(x - at, axis=1)
    assert Kriging(x).distances(at) == pytest.approx(expected, abs=1e-12)
