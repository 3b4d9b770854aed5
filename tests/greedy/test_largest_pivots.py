"""The choice of vectors is that of QR with column pivoting."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import qr

from snapspace.greedy.largest_pivots import largest_pivots


@pytest.mark.parametrize("seed", range(5))
def test_pivots_are_those_of_lapack(seed: int) -> None:
    vectors = np.random.default_rng(seed).normal(size=(30, 12)) * np.linspace(1, 5, 12)
    pivots = qr(vectors, mode="r", pivoting=True)[1]
    assert largest_pivots(vectors.T @ vectors, 12) == pivots.tolist()


def test_a_longer_choice_starts_with_the_shorter_one() -> None:
    vectors = np.random.default_rng(0).normal(size=(8, 20))
    gram = vectors.T @ vectors
    assert largest_pivots(gram, 20)[:5] == largest_pivots(gram, 5)


def test_only_one_of_two_equal_vectors_is_taken_first() -> None:
    vectors = np.array([[5.0, 5.0, 0.0], [0.0, 0.0, 1.0]])
    assert largest_pivots(vectors.T @ vectors, 2) == [0, 2]


@pytest.mark.parametrize("rank", [0, 1, 3])
def test_no_vector_is_taken_twice_when_the_rest_is_dependent(rank: int) -> None:
    vectors = np.random.default_rng(1).normal(size=(rank, 9))
    gram = vectors.T @ vectors if rank else np.zeros((9, 9))
    chosen = largest_pivots(gram, 9)
    assert sorted(chosen) == list(range(9))
    # after the independent ones only rounding is left: they come in order of their numbers
    assert chosen[rank:] == sorted(chosen[rank:])
