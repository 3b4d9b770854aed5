"""SearchOptions: the target and limits of a search for an accurate model."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class SearchOptions:
    """Target and limits of a search; None stands for the default.

    target_error, most_samples, budget, seed : as for `accurate_model`
    """

    target_error: float | None = None
    most_samples: int | None = None
    budget: float | None = None
    seed: int = 0
