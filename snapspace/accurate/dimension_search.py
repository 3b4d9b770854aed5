"""DimensionSearch: chooses the dimensions to try with the samples of a stage."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np

from .growing_samples import GrowingSamples
from .plan import Plan
from .step import Step

#: Largest number of modes per training solution: further modes fit only these solutions.
MODES_PER_SOLUTION = 0.8
#: Least growth of the dimension from one try to the next.
GROWTH = 1.2
#: The same from the last try to the most dimensions.
LAST_GROWTH = 1.1
#: If a larger dimension leaves more than this share of the error, still larger ones do not help.
FALL = 0.9
#: Safety factor of the expected error when a dimension is chosen. A median over few held-out
#: samples is uncertain, and more dimensions from the same samples cost little.
AIM = 1.5
#: The smallest safety factor. If no dimension meets the target with it, more samples are needed.
MARGIN = 1.1
#: Beyond this share of a plan's largest dimension frames get slow: there the smallest factor is
#: used.
AIMED = 0.8


class DimensionSearch:
    """Chooses dimensions by projection errors, and by the ratio of model errors to them.

    Parameters
    ----------
    growing : GrowingSamples
        The samples that are solved so far.
    plan : Plan
        How samples and dimension are chosen.
    target : float
        The wanted relative error.
    ratio : float
        Ratio of errors of reduced solutions to errors of projections, as known so far.
    """

    def __init__(self, growing: GrowingSamples, plan: Plan, target: float, ratio: float) -> None:
        self._projections = np.array([plan.typical(row) for row in growing.projection_errors()])
        most = int(MODES_PER_SOLUTION * growing.trained_solutions)
        self.most = min(plan.most_dimensions, most, len(self._projections) - 1)
        self._most_aimed = int(AIMED * plan.most_dimensions)
        self._target = target
        self._ratio = ratio
        self.steps: list[Step] = []

    def projection(self, dimension: int) -> float:
        """Typical error of the held-out samples' projections."""
        return float(self._projections[dimension])

    def add(self, step: Step) -> None:
        """Records the model of the last dimension."""
        self.steps.append(step)
        self._ratio = step.ratio

    def dimensions(self, *, last: bool) -> Iterator[int]:
        """Dimensions to try in turn, until one meets the target or more do not help.

        Empty if more samples are needed, unless these samples are the `last`.
        """
        while not self._useless():
            tried = self.steps[-1].dimension if self.steps else 0
            wanted = max(self._wanted(), ceil(GROWTH * tried), 1)
            if wanted > self.most:
                if LAST_GROWTH * tried > self.most or not last:
                    return
                wanted = self.most
            yield wanted

    def _wanted(self) -> int:
        """The dimension that is expected to meet the target; above the largest if there is none."""
        enough = self._first_below(MARGIN)
        if enough > self.most:
            return enough
        return max(enough, min(self._first_below(AIM), self.most, self._most_aimed))

    def _first_below(self, factor: float) -> int:
        expected = self._projections * self._ratio * factor
        meeting = np.flatnonzero(expected <= self._target)
        return int(meeting[0]) if len(meeting) else self.most + 1

    def _useless(self) -> bool:
        """Whether the target is met, or the last dimensions did not help."""
        errors = [step.error for step in self.steps]
        met = bool(errors) and errors[-1] <= self._target
        return met or (len(errors) > 1 and errors[-1] > FALL * errors[-2])
