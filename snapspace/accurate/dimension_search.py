"""DimensionSearch: the dimensions that are tried with the samples of a stage."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np

from .growing_samples import GrowingSamples
from .plan import Plan
from .step import Step

#: Modes for each solution that they come from: the last ones fit these alone.
MODES_PER_SOLUTION = 0.8
#: The least growth of the dimension from try to try.
GROWTH = 1.2
#: Where more dimensions leave more than this share of the error, still more are of no use.
FALL = 0.9
#: What the next try aims below the target by.
MARGIN = 1.1


class DimensionSearch:
    """Chooses dimensions by the errors of projections, and by how far models are off beyond these.

    Parameters
    ----------
    growing : GrowingSamples
    plan : Plan
    target : float
    ratio : float
        Of errors of reduced solutions to errors of projections, as far as it is known.
    """

    def __init__(self, growing: GrowingSamples, plan: Plan, target: float, ratio: float) -> None:
        self._projections = np.array([plan.typical(row) for row in growing.projection_errors()])
        most = int(MODES_PER_SOLUTION * growing.trained_solutions)
        self.most = min(plan.most_dimensions, most, len(self._projections) - 1)
        self._target = target
        self._ratio = ratio
        self.steps: list[Step] = []

    def projection(self, dimension: int) -> float:
        """Typical error of the held-out samples' projections."""
        return float(self._projections[dimension])

    def add(self, step: Step) -> None:
        """Takes what the last dimension gave."""
        self.steps.append(step)
        self._ratio = step.ratio

    def dimensions(self, *, last: bool) -> Iterator[int]:
        """One after the other, until one meets the target or more of them are of no use.

        None of them, where more samples are the cure; unless these are the last.
        """
        while not self._useless():
            tried = self.steps[-1].dimension if self.steps else 0
            enough = np.flatnonzero(self._projections * self._ratio * MARGIN <= self._target)
            wanted = max(int(enough[0]), ceil(GROWTH * tried), 1) if len(enough) else self.most + 1
            if wanted > self.most:
                if tried == self.most or not last:
                    return
                wanted = self.most
            yield wanted

    def _useless(self) -> bool:
        """Whether the target is met, or the last dimensions did not help."""
        errors = [step.error for step in self.steps]
        met = bool(errors) and errors[-1] <= self._target
        return met or (len(errors) > 1 and errors[-1] > FALL * errors[-2])
