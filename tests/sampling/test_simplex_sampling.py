"""Samples of interpolation weights are uniform: the flat Dirichlet distribution."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.stats import kstest

from snapspace import sample
from snapspace.problem.simplex import Simplex
from snapspace.sampling import METHODS


def marginal(corners: int) -> Any:
    """Distribution function of one weight; the other weights form a smaller simplex."""
    return lambda w: 1.0 - (1.0 - np.clip(w, 0.0, 1.0)) ** (corners - 1)


@pytest.mark.parametrize("corners", [2, 3, 4, 6])
@pytest.mark.parametrize("method", ["random", "sobol"])
def test_moments_are_those_of_the_flat_dirichlet_distribution(method: Any, corners: int) -> None:
    count = 4096
    weights = sample(Simplex(corners=corners), count, method=method, seed=2)
    variance = (corners - 1) / (corners**2 * (corners + 1))
    covariance = -1 / (corners**2 * (corners + 1))
    expected = np.full((corners, corners), covariance)
    np.fill_diagonal(expected, variance)
    # four standard errors of random points; the Sobol sequence is far better
    error = 4 * math.sqrt(variance / count) if method == "random" else 1e-3
    assert weights.mean(axis=0) == pytest.approx(np.full(corners, 1 / corners), abs=error)
    assert np.cov(weights.T, bias=True) == pytest.approx(expected, abs=error)


@pytest.mark.parametrize("corners", [2, 3, 4, 6])
def test_random_marginals_have_the_known_distribution(corners: int) -> None:
    weights = sample(Simplex(corners=corners), 2000, seed=3)
    for values in weights.T:
        assert kstest(values, marginal(corners)).pvalue > 1e-3


@pytest.mark.parametrize("corners", [2, 3, 4, 6])
def test_sobol_marginals_are_closer_than_random_ones(corners: int) -> None:
    """This holds for all corners, also for those that the map from the cube treats last."""
    weights = sample(Simplex(corners=corners), 1024, method="sobol")
    for values in weights.T:
        # the distance times sqrt(count) is less than 0.5 for 4 of 100 random samples
        assert kstest(values, marginal(corners)).statistic < 0.5 / math.sqrt(1024)


def test_the_distribution_test_detects_normalised_uniform_numbers() -> None:
    """They are the classical mistake, and cluster at the centre."""
    wrong = np.random.default_rng(3).random((2000, 3))
    wrong /= wrong.sum(axis=1, keepdims=True)
    assert kstest(wrong[:, 0], marginal(3)).pvalue < 1e-3


@pytest.mark.parametrize("extrapolation", [0.0, 0.25])
@pytest.mark.parametrize("method", METHODS)
def test_samples_lie_in_the_domain_and_fill_it(method: Any, extrapolation: float) -> None:
    domain = Simplex(corners=3, extrapolation=extrapolation)
    weights = sample(domain, 2080, method=method)
    assert weights.shape == (2080, 3)
    assert all(domain.contains(w) for w in weights)
    assert np.abs(weights.sum(axis=1) - 1).max() < 1e-15 * 8
    highest = 1 + extrapolation * 2 / 3
    assert weights.min(axis=0) == pytest.approx(np.full(3, domain.lowest), abs=0.02)
    assert weights.max(axis=0) == pytest.approx(np.full(3, highest), abs=0.06)


@pytest.mark.parametrize(
    "options", [{}, {"method": "sobol"}, {"method": "sobol", "scramble": False}]
)
@pytest.mark.parametrize("shorter", [1, 31, 32, 33])
def test_longer_samples_begin_with_the_shorter_ones(options: Any, shorter: int) -> None:
    domain = Simplex(corners=4)
    longer = sample(domain, 100, **options)
    assert np.array_equal(longer[:shorter], sample(domain, shorter, **options))


def test_sobol_without_scrambling_begins_at_the_last_corner_and_its_opposite() -> None:
    points = sample(Simplex(corners=2), 2, method="sobol", scramble=False)
    assert np.array_equal(points, [[0, 1], [0.5, 0.5]])


def test_thirty_of_three_weights_on_a_grid_are_28() -> None:
    assert len(sample(Simplex(corners=3), 30, method="grid")) == 28
