"""Some tets for all, those with large forces and random others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SampledTets:
    """Some tets for all.

    tets : (c,) int32, ascending
    factors : (c,), how many tets each stands for; they sum to the number of all
    """

    tets: NDArray[np.int32]
    factors: NDArray[np.float64]


#: Share of the tets with the largest forces.
LARGEST = 0.5


def sampled_tets(ordered: NDArray[np.int32], count: int, *, seed: int) -> SampledTets:
    """Half of them the first of some ordered tets, which stand for themselves, and random others.

    Forces of tets differ by many powers of ten: random tets alone leave the Dragon (d = 120) twice
    the error, the Elephant as well. The largest alone leave parts without a candidate: a long bar
    has then six times the error, and the Lion five times, where a pose squeezes a few tets.

    Parameters
    ----------
    ordered : (m,) int32, see `tets_by_force`
    count : how many, at most m
    seed : of the others
    """
    largest = round(LARGEST * min(count, len(ordered)))
    others = np.random.default_rng(seed).permutation(ordered[largest:])[: count - largest]
    tets = np.concatenate([ordered[:largest], others])
    factors = np.ones(len(tets))
    factors[largest:] = (len(ordered) - largest) / max(len(others), 1)
    places = np.argsort(tets)
    return SampledTets(tets[places], factors[places])
