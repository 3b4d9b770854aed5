"""SearchOptions: the target and limits of a search for an accurate model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

#: Gets a line of text for the user.
Tell = Callable[[str], None]
#: Gets "snapshots", "subspace" or "energy" before each of these parts of the work.
Begins = Callable[[str], None]


@dataclass(frozen=True, kw_only=True)
class SearchOptions:
    """Target and limits of a search; None stands for the default.

    target_error, most_samples, budget, seed : as for `accurate_model`
    """

    target_error: float | None = None
    most_samples: int | None = None
    budget: float | None = None
    seed: int = 0
