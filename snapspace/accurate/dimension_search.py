"""DimensionSearch: chooses the dimensions to try with the samples of a stage."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np

from .growing_samples import GrowingSamples
from .plan import Plan
from .step import Step

#: Most modes per solution that they come from: further modes fit only these solutions.
MODES_PER_SOLUTION = 0.8
#: Least growth of the dimension from one try to the next.
GROWTH = 1.2
#: The same from the last try to the most dimensions.
LAST_GROWTH = 1.1
#: If more dimensions leave more than this share of the error, still more do not help.
FALL = 0.9
#: Factor by which the next try aims below the target.
MARGIN = 1.1


class DimensionSearch:
    """Chooses dimensions by projection errors, and by how much larger errors of models are.

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

        There are none if more samples are needed, unless these samples are the `last`.
        """
        while not self._useless():
            tried = self.steps[-1].dimension if self.steps else 0
            enough = np.flatnonzero(self._projections * self._ratio * MARGIN <= self._target)
            wanted = max(int(enough[0]), ceil(GROWTH * tried), 1) if len(enough) else self.most + 1
            if wanted > self.most:
                if LAST_GROWTH * tried > self.most or not last:
                    return
                wanted = self.most
            yield wanted

    def _useless(self) -> bool:
        """Whether the target is met, or the last dimensions did not help."""
        errors = [step.error for step in self.steps]
        met = bool(errors) and errors[-1] <= self._target
        return met or (len(errors) > 1 and errors[-1] > FALL * errors[-2])
