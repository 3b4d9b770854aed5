"""SearchOptions: what a search for an accurate model aims at."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class SearchOptions:
    """What to search for; None stands for the default.

    target_error, most_samples, budget, seed : as for `accurate_model`
    """

    target_error: float | None = None
    most_samples: int | None = None
    budget: float | None = None
    seed: int = 0
