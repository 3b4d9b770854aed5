"""SearchTime: how long a search has taken, and whether its budget allows more."""

from __future__ import annotations

import time


class SearchTime:
    """The time since a search began, and its limit.

    budget : seconds, or None for no limit
    model : seconds that the last model took; 0 before the first
    """

    def __init__(self, budget: float | None) -> None:
        self._begin = time.perf_counter()
        self.budget = budget
        self.model = 0.0

    @property
    def spent(self) -> float:
        """Seconds since the search began."""
        return time.perf_counter() - self._begin

    def allows_model(self, solving: float = 0.0) -> bool:
        """Whether another model is within the budget, after so many seconds of solving.

        It is expected to take as long as the last one. The first one takes up to as long as the
        samples that it is made of.
        """
        wanted = solving + (self.model or self.spent)
        return self.budget is None or self.spent + wanted <= self.budget
