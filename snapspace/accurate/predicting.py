"""Predicting: models that only predict the next samples."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..cubature import element_count, has_stars
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Snapshots
from .dimension_search import MODES_PER_SOLUTION

Model = PosingModel | InterpolationModel
#: Makes a model from snapshots, a dimension, and the snapshots that train its energy.
Make = Callable[[Snapshots, int, Snapshots], Model]

#: Limits of a model that only predicts samples: its largest dimension, the number of snapshots that
#: train its energy, and the growth of the samples after which it is made anew.
MOST_DIMENSIONS = 64
TRAINED = 24
ENOUGH = 1.4
#: A model that only predicts has all stars of a surface with at most this many. On the Centaur's
#: 981 stars a fit takes 6 s, and could save at most 0.3 s of the predictions.
FEW_STARS = 2000


def predicting_stars(problem: PosingProblem | InterpolationProblem) -> int | None:
    """Number of stars of a model that only predicts; None for the usual number, and for tets."""
    if not has_stars(problem):
        return None
    stars = element_count(problem)
    return stars if stars <= FEW_STARS else None


class Predicting:
    """The models that predict samples where that helps much: `GrowingSamples.are_predicted`."""

    def __init__(self) -> None:
        self._model: Model | None = None
        self._count = 0  # of the samples that it is made of

    @property
    def latest(self) -> Model | None:
        """The last model; None if there is none yet."""
        return self._model

    def take(self, model: Model, solved: Snapshots) -> None:
        """Keeps the leading dimensions of a model that was made from these samples for a target.

        With 150 dimensions a prediction would take as long as the solve that starts from it.
        """
        if model.dimension > MOST_DIMENSIONS:
            model = model.leading(MOST_DIMENSIONS)
        self._model, self._count = model, len(solved)

    def model(self, solved: Snapshots | None, make: Make) -> Model | None:
        """The model that predicts the samples after these; None if there is none yet.

        make : makes the model if there are enough new samples; not stored, since it may refer to
            this object
        """
        count = 0 if solved is None else len(solved)
        if solved is not None and count >= ENOUGH * self._count:
            dimension = max(1, min(int(MODES_PER_SOLUTION * count), MOST_DIMENSIONS))
            spread = np.linspace(0, count - 1, TRAINED).round().astype(int)
            trained = solved.select(np.isin(np.arange(count), spread))
            self._model, self._count = make(solved, dimension, trained), count
        return self._model
