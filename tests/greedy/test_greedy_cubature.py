"""Greedy samples for a material whose reduced energy is a cubature."""

from __future__ import annotations

import numpy as np

from snapspace import PosingProblem, StableNeoHookean, greedy_snapshots, sample

from ..snapshots.bars import assert_same_bits, posing_bar


def problem() -> PosingProblem:
    return posing_bar(bound=0.5, material=StableNeoHookean())


def test_batches_are_chosen_where_a_model_with_few_tets_is_worst() -> None:
    chosen = greedy_snapshots(problem(), 24, batch=12, dimension=6, seed=3)
    sequence = sample(problem().domain, 12 + 36, method="sobol", seed=3)
    numbers = [int(np.flatnonzero((sequence == w).all(axis=1))[0]) for w in chosen.parameters]
    assert numbers[:12] == list(range(12))
    assert len(set(numbers)) == 24
    assert numbers[12:] != list(range(12, 24))
    assert_same_bits(chosen, greedy_snapshots(problem(), 24, batch=12, dimension=6, seed=3))


def test_the_sequence_is_used_unchanged_until_there_are_ten_samples() -> None:
    """A cubature needs ten samples for its training."""
    chosen = greedy_snapshots(problem(), 16, batch=4, dimension=6, seed=3)
    sequence = sample(problem().domain, 4 + 3 * 12, method="sobol", seed=3)
    numbers = [int(np.flatnonzero((sequence == w).all(axis=1))[0]) for w in chosen.parameters]
    assert numbers[:12] == [0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19]
    assert all(28 <= number < 40 for number in numbers[12:])
    assert numbers[12:] != [28, 29, 30, 31]
