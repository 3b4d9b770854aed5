"""Guesses: starts of samples while few samples are finished."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..problem import Problem
from .starts import interpolation_weights

FloatArray = NDArray[np.float64]

#: Guesses are worth their time up to this many finished samples per parameter. On the Dragon a
#: guess costs two evaluations, and saves as many once six samples per parameter are finished.
GUESSED = 8


class Guesses:
    """A problem's own guesses, corrected by their errors at finished samples.

    Far from all samples a corrected guess equals the guess; at a sample it equals the sample.
    Interpolating these errors leaves half to two thirds of the error of interpolating shapes.

    Parameters
    ----------
    problem : Problem
    parameters : (k, p)
        Parameters of all samples, finished or not; methods refer to samples by row.
    """

    def __init__(self, problem: Problem, parameters: FloatArray) -> None:
        self._problem = problem
        self._parameters = parameters
        self._scaled = problem.domain.scaled(parameters)
        self._rows: dict[int, FloatArray] = {}

    def corrected(
        self, wanted: Sequence[int], known: Sequence[int], rows: DisplacementRows
    ) -> FloatArray | None:
        """Starts (j, 3n) for wanted samples, from displacements (i, 3n) of the known ones.

        None if the problem has no guesses, or if enough samples are known without them.
        """
        if self._has_enough(len(known)):
            self._rows.clear()
            return None
        if not self._make_missing(wanted):
            return None
        guesses = DisplacementRows([self._rows[i] for i in wanted], rows.size)
        if len(known) < 2:  # only the rest shape is known, where guesses are exact
            return guesses.array()
        self._make_missing(known)
        weights = interpolation_weights(self._scaled[list(known)], self._scaled[list(wanted)])
        # a guess, plus the interpolated errors of the guesses at known samples
        every = guesses.followed_by(rows).followed_by([self._rows[i] for i in known])
        return every.combined(np.hstack([np.eye(len(wanted)), weights, -weights]))

    def make(self, wanted: Sequence[int], *, known: int) -> None:
        """Makes the guesses that `corrected` needs for wanted samples, given `known` others."""
        if not self._has_enough(known):
            self._make_missing(wanted)

    def _has_enough(self, known: int) -> bool:
        enough: int = GUESSED * self._parameters.shape[1]
        return known >= enough

    def _make_missing(self, samples: Sequence[int]) -> bool:
        """Makes the missing guesses; returns whether the problem has any."""
        missing = [i for i in samples if i not in self._rows]
        if missing:
            guesses = self._problem.guesses(self._parameters[missing])
            if guesses is None:
                return False
            self._rows.update(zip(missing, guesses, strict=True))
        return True
