"""Guesses: starts of samples while few are finished."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..problem import Problem
from .starts import interpolation_weights

FloatArray = NDArray[np.float64]

#: Finished samples for each parameter up to which guesses are worth their time. On the Dragon a
#: guess costs two evaluations, and saves as many where six samples for each parameter are finished.
GUESSED = 8


class Guesses:
    """A problem's own guesses, corrected by how much they have missed finished samples.

    Far from all samples a corrected guess is the guess, and at a sample the sample. Interpolating
    what guesses miss leaves half to two thirds of the error of interpolating shapes.

    Parameters
    ----------
    problem : Problem
    parameters : (k, p)
        Of all samples that are known or wanted; they are named by their rows from here on.
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

        None if the problem has no guesses, or so many samples are known that they do without.
        """
        if self._done_without(len(known)):
            self._rows.clear()
            return None
        if not self._made(wanted):
            return None
        guesses = DisplacementRows([self._rows[i] for i in wanted], rows.size)
        if len(known) < 2:  # the rest shape, where guesses miss nothing
            return guesses.array()
        self._made(known)
        weights = interpolation_weights(self._scaled[list(known)], self._scaled[list(wanted)])
        # a guess, and what guesses miss of known samples
        every = guesses.followed_by(rows).followed_by([self._rows[i] for i in known])
        return every.combined(np.hstack([np.eye(len(wanted)), weights, -weights]))

    def make(self, wanted: Sequence[int], *, known: int) -> None:
        """Makes the guesses that `corrected` needs of wanted samples, with so many known ones."""
        if not self._done_without(known):
            self._made(wanted)

    def _done_without(self, known: int) -> bool:
        enough: int = GUESSED * self._parameters.shape[1]
        return known >= enough

    def _made(self, samples: Sequence[int]) -> bool:
        """Makes the guesses that are missing; whether the problem has any."""
        missing = [i for i in samples if i not in self._rows]
        if missing:
            guesses = self._problem.guesses(self._parameters[missing])
            if guesses is None:
                return False
            self._rows.update(zip(missing, guesses, strict=True))
        return True
