"""Models: the newest models of a page, by number."""

from __future__ import annotations

from dataclasses import dataclass

from ..problem import PosingProblem, Problem
from ..reduction import PosingModel, ReducedModel

#: A page fetches a model while the next one may come.
KEPT = 2


@dataclass(frozen=True)
class KeptModel:
    """A model and what the page reads of it."""

    number: int
    model: ReducedModel
    content: bytes


class Models:
    """Numbers count from 1, also after `clear`: an address never means another model."""

    def __init__(self) -> None:
        self._kept: tuple[KeptModel, ...] = ()
        self._count = 0

    def add(self, model: ReducedModel, content: bytes) -> int:
        """Keeps a model, and lets go of the oldest one; its number."""
        self._count += 1
        self._kept = (*self._kept[1 - KEPT :], KeptModel(self._count, model, content))
        return self._count

    @property
    def newest(self) -> KeptModel | None:
        """The last model; None before the first."""
        return self._kept[-1] if self._kept else None

    def is_of(self, problem: Problem) -> bool:
        """Whether the newest model is of this problem."""
        return self.newest is not None and self.newest.model.problem is problem

    def start(self, problem: PosingProblem) -> PosingModel | None:
        """The newest model where it is of other handles, which `growing_models` can begin with.

        None where solutions are not unique, as those of St.Venant-Kirchhoff.
        """
        model = None if self.newest is None else self.newest.model
        if not isinstance(model, PosingModel) or problem.material.exact_degree == 4:
            return None
        other = model.problem.fingerprint != problem.fingerprint
        return model if other and len(model.training_parameters) else None

    def find(self, number: int) -> KeptModel | None:
        """A model by number; None if it is not there any more."""
        return next((kept for kept in self._kept if kept.number == number), None)

    def clear(self) -> None:
        """Lets go of all."""
        self._kept = ()
