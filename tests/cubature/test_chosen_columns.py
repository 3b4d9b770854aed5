"""Chosen columns: products stay right while columns come and go, on any number of threads."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace.cubature.chosen_columns import CHOSEN_PART, ChosenColumns

CANDIDATES, MOST = 60, 24


def columns(count: int, rows: int, seed: int = 0) -> NDArray[np.float32]:
    return np.random.default_rng(seed).normal(size=(count, rows)).astype(np.float32)


@given(st.integers(0, 50), st.lists(st.integers(1, 12), min_size=1, max_size=8))
def test_products_are_those_of_the_columns_that_are_left(seed: int, steps: list[int]) -> None:
    rng = np.random.default_rng(seed)
    given_columns, target = columns(CANDIDATES, 30, seed), rng.normal(size=30)
    chosen = ChosenColumns(given_columns, target, MOST)
    left = np.zeros(0, np.intp)
    for count in steps:
        others = np.setdiff1d(np.arange(CANDIDATES), left)
        fresh = np.sort(rng.permutation(others)[: min(count, MOST - len(left))])
        chosen.add(fresh)
        left = np.concatenate([left, fresh])
        kept = rng.random(len(left)) < 0.6
        chosen.keep(kept)
        left = left[kept]
        own, weights = given_columns[left].astype(np.float64), rng.random(len(left))
        np.testing.assert_allclose(chosen.gram, own @ own.T, atol=1e-12)
        np.testing.assert_allclose(chosen.moments, own @ target, atol=1e-12)
        np.testing.assert_allclose(chosen.residual(weights), target - weights @ own, atol=1e-12)


@pytest.mark.parametrize("threads", [1, 3])
def test_sums_are_the_same_on_any_number_of_threads(threads: int) -> None:
    count = 3 * CHOSEN_PART
    given_columns, target = columns(2000, 40), np.ones(40)
    chosen = [ChosenColumns(given_columns, target, count, threads=n) for n in (2, threads)]
    for one in chosen:
        one.add(np.arange(0, 2 * CHOSEN_PART + 7))
        one.keep(np.arange(2 * CHOSEN_PART + 7) % 3 > 0)
        one.add(np.arange(1000, 1000 + CHOSEN_PART))
    np.testing.assert_array_equal(chosen[0].gram, chosen[1].gram)
    found = [one.candidate_products(target) for one in chosen]
    np.testing.assert_array_equal(*found)
