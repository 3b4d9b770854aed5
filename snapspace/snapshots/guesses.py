"""Guesses: starts of samples while few are finished."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..problem import Problem
from .displacement_rows import DisplacementRows
from .starts import interpolated_start

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
        if len(known) >= GUESSED * self._parameters.shape[1]:
            self._rows.clear()
            return None
        if not self._made(wanted):
            return None
        guesses = np.stack([self._rows[i] for i in wanted])
        if len(known) < 2:  # the rest shape, where guesses miss nothing
            return guesses
        self._made(known)
        missed = [row - self._rows[i] for i, row in zip(known, rows, strict=True)]
        corrections = DisplacementRows(missed, rows.size)
        return guesses + interpolated_start(
            self._scaled[list(known)], corrections, self._scaled[list(wanted)]
        )

    def _made(self, samples: Sequence[int]) -> bool:
        """Makes the guesses that are missing; whether the problem has any."""
        missing = [i for i in samples if i not in self._rows]
        if missing:
            guesses = self._problem.guesses(self._parameters[missing])
            if guesses is None:
                return False
            self._rows.update(zip(missing, guesses, strict=True))
        return True
