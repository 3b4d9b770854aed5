from __future__ import annotations

import itertools
import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from snapspace.problem.simplex import Simplex

FloatArray = NDArray[np.float64]


def to_unit(domain: Simplex, weights: FloatArray) -> FloatArray:
    """The inverse of `from_unit`: each weight's distribution function given the earlier weights."""
    w = (weights - domain.lowest) / (1 + domain.extrapolation)
    left = 1 - np.concatenate([np.zeros((len(w), 1)), np.cumsum(w, axis=1)[:, :-2]], axis=1)
    return 1 - (1 - w[:, :-1] / left) ** np.arange(domain.dimension, 0, -1)


@given(arrays(np.float64, (3, 4), elements=st.floats(0, 1)))
@settings(max_examples=50)
def test_every_point_of_the_cube_becomes_weights(points: FloatArray) -> None:
    weights = Simplex(corners=5).from_unit(points)
    assert weights.shape == (3, 5)
    assert (weights >= 0).all()
    assert np.abs(weights.sum(axis=1) - 1).max() <= 4 * np.finfo(float).eps


@given(
    points=arrays(np.float64, (3, 4), elements=st.floats(0, 0.99)),
    extrapolation=st.sampled_from([0.0, 0.3, 2.0]),
)
@settings(max_examples=50)
def test_the_map_from_the_cube_is_one_to_one(points: FloatArray, extrapolation: float) -> None:
    domain = Simplex(corners=5, extrapolation=extrapolation)
    assert to_unit(domain, domain.from_unit(points)) == pytest.approx(points, abs=1e-9)


def test_the_map_keeps_volumes() -> None:
    """Its Jacobian is the volume of the simplex, 1 / (corners - 1)!, everywhere."""
    domain, step = Simplex(corners=4), 1e-6
    for point in np.random.default_rng(0).uniform(0.05, 0.95, (20, 3)):
        ends = domain.from_unit(point + step * np.vstack([np.eye(3), -np.eye(3)]))[:, :3]
        jacobian = (ends[:3] - ends[3:]) / (2 * step)
        assert abs(np.linalg.det(jacobian)) == pytest.approx(1 / 6, rel=1e-6)


def test_corners_of_the_cube_become_corners_of_the_simplex() -> None:
    domain = Simplex(corners=3)
    assert np.array_equal(domain.from_unit(np.array([[0.0, 0.0]])), [[0, 0, 1]])
    assert np.array_equal(domain.from_unit(np.array([[0.0, 1.0]])), [[0, 1, 0]])
    assert np.array_equal(domain.from_unit(np.array([[1.0, 0.4]])), [[1, 0, 0]])


def test_two_weights_are_a_line() -> None:
    points = np.linspace(0, 1, 5)[:, None]
    weights = Simplex(corners=2).from_unit(points)
    assert np.array_equal(weights, np.hstack([points, 1 - points]))


def test_extrapolation_enlarges_the_simplex_about_its_centre() -> None:
    plain, wide = Simplex(corners=3), Simplex(corners=3, extrapolation=0.6)
    points = np.random.default_rng(1).random((50, 2))
    for a, b in (
        (plain.from_unit(points), wide.from_unit(points)),
        (plain.grid(50), wide.grid(50)),
    ):
        assert b - wide.center == pytest.approx(1.6 * (a - plain.center))
    assert wide.lowest == pytest.approx(-0.2)
    assert plain.lowest == 0.0 and math.copysign(1, plain.lowest) == 1
    assert wide.contains([-0.2, 0.6, 0.6]) and not plain.contains([-0.2, 0.6, 0.6])
    assert not wide.contains([-0.21, 0.61, 0.6])


def test_a_grid_of_two_weights_has_the_middles_of_equal_intervals() -> None:
    assert Simplex(corners=2).grid(4)[:, 0].tolist() == [0.125, 0.375, 0.625, 0.875]


def test_a_grid_of_three_weights_in_order() -> None:
    steps = [(0, 0, 2), (0, 1, 1), (0, 2, 0), (1, 0, 1), (1, 1, 0), (2, 0, 0)]
    expected = (np.array(steps) + 1 / 3) / 3
    assert Simplex(corners=3).grid(9) == pytest.approx(expected)


@given(count=st.integers(1, 500), corners=st.integers(2, 6))
@settings(max_examples=50)
def test_a_grid_is_the_largest_that_is_symmetric_in_the_corners(count: int, corners: int) -> None:
    domain = Simplex(corners=corners)
    weights = domain.grid(count)
    spacings = np.diff(np.unique(weights[:, 0].round(12)))
    level = 0 if len(weights) == 1 else round(1 / spacings[0]) - 1
    assert len(weights) == math.comb(level + corners - 1, corners - 1) <= count
    assert math.comb(level + corners, corners - 1) > count
    assert np.abs(weights.sum(axis=1) - 1).max() < 1e-14 and weights.min() > 0
    assert weights.mean(axis=0) == pytest.approx(domain.center)
    rows = {tuple(row) for row in weights.round(9).tolist()}
    assert len(rows) == len(weights)
    for i, j in itertools.combinations(range(corners), 2):
        swapped = weights.copy()
        swapped[:, [i, j]] = swapped[:, [j, i]]
        assert {tuple(row) for row in swapped.round(9).tolist()} == rows


def test_center_dimension_and_distances() -> None:
    domain = Simplex(corners=4)
    assert domain.dimension == 3
    assert domain.free_axes.tolist() == [True] * 3
    assert domain.center.tolist() == [0.25] * 4
    assert np.array_equal(domain.grid(1)[0], domain.center)
    weights = domain.grid(20)
    assert np.array_equal(domain.scaled(weights), weights)


@pytest.mark.parametrize(
    "weights", [[0, 0, 1], [0.2, 0.3, 0.5], [-9e-10, 0.5, 0.5 + 9e-10], [1 / 3 + 3e-10] * 3]
)
def test_weights_in_the_domain_are_returned_unchanged(weights: list[float]) -> None:
    checked = Simplex(corners=3).check(weights)
    assert checked.dtype == np.float64
    assert checked.tolist() == weights
    assert Simplex(corners=3).contains(weights)


@pytest.mark.parametrize("corners", [2, 3, 8, 20])
def test_weights_in_single_precision_sum_to_one(corners: int) -> None:
    weights = np.random.default_rng(corners).random((200, corners), dtype=np.float32)
    weights /= weights.sum(axis=1, keepdims=True)  # the cure that the message names
    sums = weights.astype(np.float64).sum(axis=1)
    assert np.abs(sums - 1.0).max() > 1e-8, "these weights do miss the sum"
    assert all(Simplex(corners=corners).contains(w) for w in weights)


def test_extrapolated_weights_on_request() -> None:
    domain = Simplex(corners=2)
    assert domain.check([-1.5, 2.5], extrapolate=True).tolist() == [-1.5, 2.5]
    with pytest.raises(ValueError, match=r"sum to 1\.1"):
        domain.check([-1.5, 2.6], extrapolate=True)


BAD_WEIGHTS: list[tuple[Any, str]] = [
    ([0.5, 0.5], "3 poses need 3 weights, got 2"),
    ([], "3 poses need 3 weights, got 0"),
    (1.0, "3 poses need 3 weights, got ()"),
    (np.full((2, 3), 1 / 3), "3 poses need 3 weights, got (2, 3)"),
    (["a", "b", "c"], "weights must be 3 numbers, one per pose"),
    ([[1], [2, 3], []], "weights must be 3 numbers, one per pose"),
    ([0.5, np.nan, 0.5], "weight 1 is nan, but it must be finite"),
    ([0.5, 0.5, np.inf], "weight 2 is inf, but it must be finite"),
    ([0.2, 0.3, 0.6], "the weights sum to 1.1, but they must sum to 1; divide them by their sum"),
    ([0, 0, 1 + 2e-6], "the weights sum to 1.000002, but they must sum to 1"),
    ([0.5, -0.1, 0.6], "weight 1 is -0.1, but none may be below 0; InterpolationProblem(extrapola"),
]


@pytest.mark.parametrize(("weights", "message"), BAD_WEIGHTS)
def test_wrong_weights_are_refused(weights: Any, message: str) -> None:
    domain = Simplex(corners=3)
    with pytest.raises(ValueError, match=re.escape(f"Simplex: {message}")) as caught:
        domain.check(weights)
    assert "\n" not in str(caught.value)
    assert not domain.contains(weights)
    with pytest.raises(ValueError, match=re.escape(f"blend: {message}")):
        domain.check(weights, who="blend")


def test_the_bound_of_a_larger_domain_is_named() -> None:
    domain = Simplex(corners=2, extrapolation=0.5)
    with pytest.raises(
        ValueError, match=re.escape("weight 0 is -0.3, but none may be below -0.25")
    ):
        domain.check([-0.3, 1.3])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"corners": 1}, "corners is 1, but weights need two poses or more"),
        ({"corners": 0}, "corners is 0, but"),
        ({"corners": 3, "extrapolation": -0.1}, "extrapolation is -0.1, but it must be zero or"),
        ({"corners": 3, "extrapolation": np.nan}, "extrapolation is nan, but"),
        ({"corners": 3, "extrapolation": np.inf}, "extrapolation is inf, but"),
    ],
)
def test_wrong_domains_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"Simplex: {message}")):
        Simplex(**arguments)
