"""Models: the newest models of a page, with their numbers."""

from __future__ import annotations

from dataclasses import dataclass

from ..problem import PosingProblem, Problem, is_quartic
from ..reduction import PosingModel, ReducedModel

#: Number of stored models: a page may still be fetching a model when the next one is added.
KEPT = 2


@dataclass(frozen=True)
class KeptModel:
    """A model, the packed content that the page reads, and its error, None if not measured."""

    number: int
    model: ReducedModel
    content: bytes
    error: float | None


class Models:
    """The last `KEPT` models.

    Numbers start at 1 and continue after `clear`, so that an address never refers to another model.

    Parameters
    ----------
    own : ReducedModel, optional
        The model that the page begins with, number 0.
    """

    def __init__(self, own: ReducedModel | None = None) -> None:
        self._own = own
        self._kept: tuple[KeptModel, ...] = ()
        self._count = 0

    def add(self, model: ReducedModel, content: bytes, *, error: float | None = None) -> int:
        """Stores a model, drops the oldest one, and returns the new model's number."""
        self._count += 1
        self._kept = (*self._kept[1 - KEPT :], KeptModel(self._count, model, content, error))
        return self._count

    @property
    def newest(self) -> KeptModel | None:
        """The last model; None before the first."""
        return self._kept[-1] if self._kept else None

    @property
    def current(self) -> ReducedModel | None:
        """The newest model, or the page's initial one; None if there is neither."""
        return self._own if self.newest is None else self.newest.model

    def is_of(self, problem: Problem) -> bool:
        """Whether the newest model is of this problem."""
        return self.newest is not None and self.newest.model.problem is problem

    def start(self, problem: PosingProblem) -> PosingModel | None:
        """The newest model if it has other handles and `growing_models` can start from it."""
        return None if self.newest is None else usable_start(self.newest.model, problem)

    def find(self, number: int) -> KeptModel | None:
        """The model of a number; None if it is no longer kept."""
        return next((kept for kept in self._kept if kept.number == number), None)

    def get(self, number: int) -> ReducedModel:
        """The model of a number; ValueError if it is no longer kept."""
        if number == 0 and self._own is not None:
            return self._own
        kept = self.find(number)
        if kept is None:
            raise ValueError(f"model {number} is no longer kept; use the newest one")
        return kept.model

    def clear(self) -> None:
        """Drops all models, including the page's initial one."""
        self._own, self._kept = None, ()


def usable_start(model: ReducedModel, problem: PosingProblem) -> PosingModel | None:
    """The model if it has other handles than the problem and `growing_models` can start from it.

    None for materials whose solutions are not unique, such as St.Venant-Kirchhoff, and for models
    that were made without snapshots.
    """
    if not isinstance(model, PosingModel) or is_quartic(problem):
        return None
    other = model.problem.fingerprint != problem.fingerprint
    return model if other and len(model.training_parameters) > 1 else None
