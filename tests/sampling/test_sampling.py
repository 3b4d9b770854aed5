from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.stats import kstest, qmc

from snapspace import HandleBox, sample
from snapspace.sampling import ANYWHERE

FloatArray = NDArray[np.float64]
BOX = HandleBox(translation=(0.5, 1.0, 2.0), angle=(0.1, 0.2, 3.0), moving=2)


@dataclass(frozen=True)
class UnitCube:
    """A domain that is the unit cube itself; its grid is the centre."""

    dimension: int

    def from_unit(self, points: FloatArray) -> FloatArray:
        return points

    def grid(self, count: int) -> FloatArray:
        return np.full((1, self.dimension), 0.5)


CUBE = UnitCube(6)


@pytest.mark.parametrize("method", ANYWHERE)
def test_samples_lie_in_the_box_and_fill_it(method: Any) -> None:
    points = sample(BOX, 4096, method=method)
    assert points.shape == (4096, 12)
    assert (np.abs(points) <= BOX.half_widths).all()
    # a grid of two cells per axis has its centres halfway out
    filled = 0.5 if method == "grid" else 0.99
    assert (np.abs(points).max(axis=0) >= filled * BOX.half_widths).all()


def test_random_marginals_are_uniform_and_independent() -> None:
    points = sample(BOX, 2000, seed=3)
    for values, width in zip(points.T, BOX.half_widths, strict=True):
        assert kstest(values, "uniform", args=(-width, 2 * width)).pvalue > 1e-3
    correlation = np.corrcoef(points.T) - np.eye(12)
    assert np.abs(correlation).max() < 4 / math.sqrt(len(points))


def test_the_kolmogorov_smirnov_test_detects_a_warped_distribution() -> None:
    warped = sample(CUBE, 2000, seed=3) ** 1.2
    assert kstest(warped[:, 0], "uniform").pvalue < 1e-3


def test_sobol_begins_with_the_known_points() -> None:
    """The points of Sobol 1967, from the tables of Joe & Kuo."""
    points = sample(UnitCube(2), 8, method="sobol", scramble=False)
    table = [
        [0, 0],
        [0.5, 0.5],
        [0.75, 0.25],
        [0.25, 0.75],
        [0.375, 0.375],
        [0.875, 0.875],
        [0.625, 0.125],
        [0.125, 0.625],
    ]
    assert np.array_equal(points, table)
    assert not sample(CUBE, 1, method="sobol", scramble=False).any()
    assert np.array_equal(sample(BOX, 1, method="sobol", scramble=False)[0], -BOX.half_widths)


@pytest.mark.parametrize("scramble", [False, True])
def test_sobol_puts_one_point_into_each_slab(scramble: bool) -> None:
    """The first 2^k points cut every axis into 2^k slabs with one point each."""
    points = sample(CUBE, 64, method="sobol", scramble=scramble)
    for axis in points.T:
        assert sorted(np.floor(64 * axis)) == list(range(64))


@pytest.mark.parametrize("scramble", [False, True])
def test_sobol_is_spread_more_evenly_than_random(scramble: bool) -> None:
    sobol = qmc.discrepancy(sample(CUBE, 256, method="sobol", scramble=scramble))
    random = [qmc.discrepancy(sample(CUBE, 256, seed=seed)) for seed in range(10)]
    assert sobol < 0.5 * min(random)


@pytest.mark.parametrize("method", ANYWHERE)
def test_the_same_arguments_give_the_same_points(method: Any) -> None:
    first = sample(BOX, 50, method=method, seed=7)
    assert np.array_equal(first, sample(BOX, 50, method=method, seed=7))


@pytest.mark.parametrize(
    ("options", "differs"),
    [
        ({"method": "random"}, True),
        ({"method": "sobol"}, True),
        ({"method": "sobol", "scramble": False}, False),
        ({"method": "grid"}, False),
    ],
)
def test_the_seed_matters_where_points_are_random(options: Any, differs: bool) -> None:
    a, b = (sample(BOX, 20, seed=seed, **options) for seed in (0, 1))
    assert np.array_equal(a, b) != differs


@pytest.mark.parametrize(
    "options", [{}, {"method": "sobol"}, {"method": "sobol", "scramble": False}]
)
@pytest.mark.parametrize("shorter", [1, 31, 32, 33])
def test_longer_samples_begin_with_the_shorter_ones(options: Any, shorter: int) -> None:
    assert np.array_equal(sample(BOX, 100, **options)[:shorter], sample(BOX, shorter, **options))


def box(free: int, moving: int = 1) -> HandleBox:
    """A box of bounds 0.5, and so of width 1, along the first `free` axes of each handle."""
    x, y, z, *angles = [0.5] * free + [0.0] * (6 - free)
    return HandleBox(translation=(x, y, z), angle=(angles[0], angles[1], angles[2]), moving=moving)


def test_a_grid_has_the_centres_of_equal_cells() -> None:
    points = sample(box(2), 6, method="grid")[:, :2]
    expected = [[(i + 0.5) / 3 - 0.5, (j + 0.5) / 2 - 0.5] for i in range(3) for j in range(2)]
    assert points == pytest.approx(np.array(expected))
    wide = HandleBox(translation=3.0, angle=1.0)
    assert sorted(set(sample(wide, 729, method="grid")[:, 0].round(12))) == [-2.0, 0.0, 2.0]


@given(count=st.integers(1, 3000), free=st.integers(1, 6), moving=st.integers(1, 2))
@settings(max_examples=50)
def test_a_grid_is_the_largest_product_of_nearly_equal_numbers(
    count: int, free: int, moving: int
) -> None:
    domain = box(free, moving)
    points = sample(domain, count, method="grid")
    per_axis = [len(np.unique(axis.round(12))) for axis in points.T[domain.free_axes]]
    assert len(points) == math.prod(per_axis) <= count
    assert max(per_axis) - min(per_axis) <= 1
    assert per_axis == sorted(per_axis, reverse=True)
    next_axis = per_axis.index(min(per_axis))
    assert len(points) // per_axis[next_axis] * (per_axis[next_axis] + 1) > count
    assert len(np.unique(points.round(12), axis=0)) == len(points)


def test_three_hundred_in_six_dimensions_are_216() -> None:
    assert len(sample(box(6), 300, method="grid")) == 216


def test_the_domain_makes_its_own_grid() -> None:
    assert np.array_equal(sample(CUBE, 300, method="grid"), np.full((1, 6), 0.5))


def test_a_grid_does_not_divide_axes_without_width() -> None:
    points = sample(HandleBox(translation=1.0, angle=0.0), 300, method="grid")
    assert len(points) == 7 * 7 * 6
    assert len(np.unique(points, axis=0)) == len(points)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"count": 0}, "the number of samples is 0, but must be at least 1"),
        ({"count": -5}, "the number of samples is -5, but must be at least 1"),
        ({"count": 3.5}, "the number of samples is 3.5, but must be a whole number"),
        ({"count": 4, "seed": -1}, "the seed is -1, but must not be negative"),
        ({"count": 4, "method": "halton"}, "unknown method 'halton'; known are random, sobol, gr"),
    ],
)
def test_bad_arguments_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"sample: {message}")):
        sample(BOX, **arguments)


def test_a_problem_in_place_of_its_domain_is_refused_with_the_cure() -> None:
    class Problem:
        domain = BOX

    with pytest.raises(ValueError, match=r"sample: the domain is a Problem; give problem\.domain"):
        sample(Problem(), 3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="the domain is a dict; give a HandleBox or Simplex"):
        sample({}, 3)  # type: ignore[arg-type]
