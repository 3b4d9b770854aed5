"""Few positive weights: planted ones are found, and errors are near those of SciPy's solver."""

from __future__ import annotations

from itertools import pairwise
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import nnls

from snapspace.cubature.nonnegative_fit import drawn, nonnegative_fit, nonnegative_weights

FloatArray = NDArray[np.float64]


def columns(rows: int, count: int, seed: int = 0) -> NDArray[np.float32]:
    return np.random.default_rng(seed).normal(size=(rows, count)).astype(np.float32)


def test_a_planted_sum_of_few_columns_is_found_again() -> None:
    A = columns(80, 200)
    planted = np.array([3, 50, 51, 120, 199])
    weights = np.array([2.0, 0.5, 1.0, 4.0, 0.1])
    chosen, found = nonnegative_fit(A.T.copy(), A[:, planted].astype(float) @ weights, 20)
    large = found > 1e-4
    np.testing.assert_array_equal(chosen[large], planted)
    assert found[large] == pytest.approx(weights, rel=1e-4)


@given(st.integers(0, 50), st.integers(1, 30))
def test_weights_are_positive_and_no_more_than_asked_for(seed: int, count: int) -> None:
    A = columns(40, 60, seed)
    target = A.sum(axis=1, dtype=float)
    chosen, weights = nonnegative_fit(A.T.copy(), target, count)
    assert 1 <= len(chosen) <= count
    assert (weights > 0).all()
    assert (np.diff(chosen) > 0).all()
    residual = target - A[:, chosen].astype(float) @ weights
    # at the minimum over the chosen columns the residual is orthogonal to each of them
    along = A[:, chosen].T.astype(float) @ residual
    assert along == pytest.approx(np.zeros(len(chosen)), abs=1e-5 * np.linalg.norm(target) * 10)


@pytest.mark.parametrize("seed", range(5))
def test_more_columns_are_never_worse_and_near_the_best_possible(seed: int) -> None:
    A = columns(60, 40, seed)
    target = np.random.default_rng(100 + seed).normal(size=60) + A.sum(axis=1)
    _, best = nnls(A.astype(float), target)
    errors = []
    for count in (5, 10, 20, 40):
        chosen, weights = nonnegative_fit(A.T.copy(), target, count)
        errors.append(np.linalg.norm(A[:, chosen].astype(float) @ weights - target))
    assert all(later <= former * (1 + 1e-9) for former, later in pairwise(errors))
    assert best * (1 - 1e-6) <= errors[-1] <= 1.05 * best


def test_a_target_that_no_positive_sum_approaches_gets_no_columns() -> None:
    A = np.abs(columns(20, 30))
    chosen, weights = nonnegative_fit(A.T.copy(), -np.ones(20), 10)
    assert len(chosen) == len(weights) == 0


def test_columns_that_hardly_matter_get_no_huge_weights() -> None:
    A = columns(60, 100)
    A[:, 50:] *= 1e-9  # tets that move rigidly
    target = A.sum(axis=1, dtype=float) + 0.1 * np.random.default_rng(5).normal(size=60)
    chosen, weights = nonnegative_fit(A.T.copy(), target, 30)
    assert (chosen < 50).all()
    assert weights.max() < 100


def test_without_active_bounds_the_weights_solve_the_normal_equations() -> None:
    A = np.abs(columns(30, 6)).astype(float)
    x = np.arange(1.0, 7.0)
    gram = A.T @ A
    assert nonnegative_weights(gram, gram @ x, np.zeros(6)) == pytest.approx(x, rel=1e-5)


def test_the_result_is_not_worse_than_the_start() -> None:
    A = columns(30, 12).astype(float)
    target = np.random.default_rng(3).normal(size=30)
    start = np.abs(np.random.default_rng(4).normal(size=12))
    x = nonnegative_weights(A.T @ A, A.T @ target, start)
    assert (x >= 0).all()
    assert np.linalg.norm(A @ x - target) <= np.linalg.norm(A @ start - target)


def test_columns_are_drawn_in_proportion_to_their_products() -> None:
    products = np.array([1.0, 0.0, 2.0, -3.0, 4.0], np.float32)
    rng = np.random.default_rng(0)
    draws = 7000
    counts = np.bincount([drawn(products, 1, rng)[0] for _ in range(draws)], minlength=5)
    expected = draws * np.array([1, 0, 2, 0, 4]) / 7
    assert counts == pytest.approx(expected, abs=4 * np.sqrt(draws / 4))  # four deviations
    assert counts[1] == counts[3] == 0


@given(st.integers(0, 1000), st.integers(0, 30))
def test_no_column_is_drawn_twice_and_none_without_a_product(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    products = rng.normal(size=20).astype(np.float32)
    some = drawn(products, count, rng)
    assert len(some) == min(count, (products > 0).sum())
    assert (np.diff(some) > 0).all() and (products[some] > 0).all()


@pytest.mark.parametrize("seed", range(3))
def test_columns_that_are_alike_do_not_fill_the_batches(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Forty kinds of columns, fifty of each: with the largest products it takes over 30 rounds."""
    rng = np.random.default_rng(seed)
    kinds = np.abs(rng.normal(size=(40, 120))) * np.exp(rng.normal(size=(40, 1)))
    alike = np.repeat(kinds, 50, axis=0) * (1 + 0.05 * rng.normal(size=(2000, 120)))
    candidates = alike.astype(np.float32)
    target = candidates.sum(axis=0, dtype=float)
    solve = Mock(wraps=nonnegative_weights)
    monkeypatch.setattr("snapspace.cubature.nonnegative_fit.nonnegative_weights", solve)
    chosen, weights = nonnegative_fit(candidates, target, 60, seed=seed)
    error = np.linalg.norm(weights @ candidates[chosen].astype(float) - target)
    assert error < 0.01 * np.linalg.norm(target)
    assert solve.call_count <= 15


def test_a_seed_gives_the_same_choice_on_any_number_of_threads() -> None:
    A = np.abs(columns(200, 1500)).T.copy()
    target = A.sum(axis=0, dtype=float)
    one, two = (nonnegative_fit(A, target, 60, seed=3, threads=t) for t in (1, 2))
    np.testing.assert_array_equal(one[0], two[0])
    np.testing.assert_array_equal(one[1], two[1])
    assert not np.array_equal(one[0], nonnegative_fit(A, target, 60, seed=4)[0])
