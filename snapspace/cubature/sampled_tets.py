"""A sample of the tets: those with the largest forces, and random others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SampledTets:
    """A sample that represents all tets.

    tets : (c,) int32, ascending
    factors : (c,), the number of tets that each represents; they sum to the number of all tets
    """

    tets: NDArray[np.int32]
    factors: NDArray[np.float64]


#: Share of the sample that has the largest forces.
LARGEST = 0.5


def sampled_tets(ordered: NDArray[np.int32], count: int, *, seed: int) -> SampledTets:
    """Draws a sample: half of it are the first tets in order, and half are random others.

    The first ones represent only themselves. Forces of tets differ by many powers of ten: with
    random tets alone the error doubles on the Dragon (d = 120) and on the Elephant. The largest
    forces alone leave parts of a body without a candidate: a long bar then has six times the error,
    and the Lion, where a pose compresses a few tets, five times.

    Parameters
    ----------
    ordered : (m,) int32
        Tets in the order of `tets_by_force`.
    count : int
        Size of the sample, at most m.
    seed : int
        Seed of the random tets.
    """
    largest = round(LARGEST * min(count, len(ordered)))
    others = np.random.default_rng(seed).permutation(ordered[largest:])[: count - largest]
    tets = np.concatenate([ordered[:largest], others])
    factors = np.ones(len(tets))
    factors[largest:] = (len(ordered) - largest) / max(len(others), 1)
    places = np.argsort(tets)
    return SampledTets(tets[places], factors[places])
