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
#: Makes a model of snapshots, with a dimension, and with the snapshots that train its energy.
Make = Callable[[Snapshots, int, Snapshots], Model]

#: A model that only predicts samples has at most so many dimensions, its energy is trained by so
#: many snapshots, and it is made anew once there are so many times as many samples.
MOST_DIMENSIONS = 64
TRAINED = 24
ENOUGH = 1.4
#: A model that only predicts has all stars of a surface with no more than these. On the Centaur's
#: 981 a fit takes 6 s, and all that it would save of the predictions 0.3 s.
FEW_STARS = 2000


def predicting_stars(problem: PosingProblem | InterpolationProblem) -> int | None:
    """How many stars a model has that only predicts; None for the usual number, and for tets."""
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
        """The last one; None if there is none yet."""
        return self._model

    def take(self, model: Model, solved: Snapshots) -> None:
        """Takes the leading dimensions of a model that was made of these samples to meet a target.

        With 150 dimensions a prediction takes as long as the solve that it starts.
        """
        if model.dimension > MOST_DIMENSIONS:
            model = model.leading(MOST_DIMENSIONS)
        self._model, self._count = model, len(solved)

    def model(self, solved: Snapshots | None, make: Make) -> Model | None:
        """The model that predicts the samples after these; None if there is none yet.

        make : makes it, if there are enough more samples; not kept, for it may refer to this object
        """
        count = 0 if solved is None else len(solved)
        if solved is not None and count >= ENOUGH * self._count:
            dimension = max(1, min(int(MODES_PER_SOLUTION * count), MOST_DIMENSIONS))
            spread = np.linspace(0, count - 1, TRAINED).round().astype(int)
            trained = solved.select(np.isin(np.arange(count), spread))
            self._model, self._count = make(solved, dimension, trained), count
        return self._model
