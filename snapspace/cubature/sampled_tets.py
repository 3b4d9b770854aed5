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


def sampled_tets(
    ordered: NDArray[np.int32], count: int, *, largest_share: float, seed: int
) -> SampledTets:
    """The first of some ordered tets, which stand for themselves, and random others.

    Forces of tets differ by many powers of ten. On the Dragon, d = 120, cubatures chosen from the
    quarter with the largest forces and from all tets have the same errors, and the columns of all
    need four times the memory. Where a few tets are squeezed they would be the only candidates: see
    `BlendingStates.largest_share`.

    Parameters
    ----------
    ordered : (m,) int32, see `tets_by_force`
    count : how many, at most m
    largest_share : share of the first ones
    seed : of the others
    """
    largest = round(largest_share * min(count, len(ordered)))
    others = np.random.default_rng(seed).permutation(ordered[largest:])[: count - largest]
    tets = np.concatenate([ordered[:largest], others])
    factors = np.ones(len(tets))
    factors[largest:] = (len(ordered) - largest) / max(len(others), 1)
    places = np.argsort(tets)
    return SampledTets(tets[places], factors[places])
