"""Orders of pairs and triples: complete, without repetition, and fair at every length."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace.problem.corner_sets import pairs_in_rounds, triples_in_circles

CORNERS = range(2, 21)


def uses(sets: NDArray[np.int64], corners: int) -> NDArray[np.int64]:
    """How often each corner is in the first k sets, (k, corners)."""
    counts = np.zeros((len(sets), corners), np.int64)
    for row, chosen in zip(counts, sets, strict=True):
        row[chosen] = 1
    return np.cumsum(counts, axis=0)


@pytest.mark.parametrize("corners", CORNERS)
def test_every_pair_comes_once(corners: int) -> None:
    pairs = pairs_in_rounds(corners)
    assert sorted(map(sorted, pairs.tolist())) == [
        list(pair) for pair in itertools.combinations(range(corners), 2)
    ]


@pytest.mark.parametrize("corners", CORNERS)
def test_every_triple_comes_once(corners: int) -> None:
    triples = triples_in_circles(corners, at_most=10_000)
    assert sorted(map(sorted, triples.tolist())) == [
        list(triple) for triple in itertools.combinations(range(corners), 3)
    ]


@pytest.mark.parametrize("corners", CORNERS)
def test_at_every_length_corners_are_used_nearly_equally_often(corners: int) -> None:
    assert np.ptp(uses(pairs_in_rounds(corners), corners), axis=1).max() <= 1 + corners % 2
    triples = triples_in_circles(corners, at_most=10_000)
    if len(triples):
        assert np.ptp(uses(triples, corners), axis=1).max() <= 3


@pytest.mark.parametrize("corners", CORNERS)
def test_each_corner_comes_first_in_half_of_its_pairs(corners: int) -> None:
    first = np.bincount(pairs_in_rounds(corners)[:, 0], minlength=corners)
    assert np.abs(first - (corners - 1) / 2).max() <= 0.5


@pytest.mark.parametrize("at_most", [1, 7, 40])
def test_fewer_triples_are_the_first_of_all_triples(at_most: int) -> None:
    triples = triples_in_circles(9, at_most=10_000)
    assert len(triples) == math.comb(9, 3)
    assert np.array_equal(triples_in_circles(9, at_most=at_most), triples[:at_most])


def test_wide_triples_come_first() -> None:
    assert sorted(triples_in_circles(9, at_most=3).tolist()[0]) == [0, 3, 6]
