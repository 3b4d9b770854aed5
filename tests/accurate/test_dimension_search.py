"""Which dimensions a stage of the search tries, for errors of projections that fall as 1 / d."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import cast

import numpy as np
from numpy.typing import NDArray

from snapspace.accurate.dimension_search import AIM, MARGIN, DimensionSearch
from snapspace.accurate.growing_samples import GrowingSamples
from snapspace.accurate.plan import MOTIONS
from snapspace.accurate.step import Step

TARGET, RATIO = 0.003, 5.0


@dataclass(frozen=True)
class Projections:
    """The part of samples that a search reads; projection errors are `scale / d`."""

    trained_solutions: int
    scale: float

    def projection_errors(self) -> NDArray[np.float64]:
        dimensions = np.arange(self.trained_solutions + 1.0)
        return (self.scale / np.maximum(dimensions, 0.5))[:, None]


def search(solutions: int, *, meets_at: float) -> DimensionSearch:
    """The search of a stage whose models are expected to meet the target at a dimension."""
    samples = Projections(trained_solutions=solutions, scale=meets_at * TARGET / RATIO)
    return DimensionSearch(cast(GrowingSamples, samples), MOTIONS, TARGET, RATIO)


def tried(dimension: int, error: float, projection: float) -> Step:
    return Step(
        samples=0,
        dimension=dimension,
        projection=projection,
        error=error,
        mean=error,
        ninth=error,
        unseen="motions",
        typical="median",
    )


def test_the_search_aims_well_below_the_target_where_the_samples_suffice() -> None:
    assert next(search(400, meets_at=60).dimensions(last=False)) == AIM * 60


def test_a_lower_aim_never_costs_samples() -> None:
    tries = search(100, meets_at=60)
    assert MARGIN * 60 < tries.most < AIM * 60
    assert next(tries.dimensions(last=False)) == tries.most
    assert not list(search(80, meets_at=60).dimensions(last=False))


def test_slow_models_aim_no_lower_than_they_must() -> None:
    assert next(search(500, meets_at=200).dimensions(last=False)) == 256
    assert next(search(500, meets_at=248).dimensions(last=False)) == ceil(MARGIN * 248)


def test_the_next_try_follows_from_the_last_error() -> None:
    """At 90 dimensions the ratio turns out to be 10 instead of 5; the samples suffice for 180."""
    tries = search(400, meets_at=60)
    dimensions = tries.dimensions(last=False)
    first = next(dimensions)
    projection = tries.projection(first)
    tries.add(tried(first, 10.0 * projection, projection))
    assert next(dimensions) == AIM * 120
