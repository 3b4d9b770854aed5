"""Publishing: gives a page the models of one computation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..accurate import Growth
from ..page import packed
from ..reduction import PosingModel
from ..stopping import check_stop
from .message_parts import HandleChoice
from .messages import Model, ServerMessage
from .models import Models

#: The handle painted at each surface vertex of a model, as for `packed`.
Owners = Callable[[PosingModel], NDArray[np.int32] | None]


@dataclass(kw_only=True)
class Publishing:
    """Called with each model of a computation, and the seconds since it began.

    models : the page's models; each new one is added
    request : that of the computation
    name : heading of the page
    up : callable that gives the axis that points up
    owners, mirror : callables, called with each model
    kept : points that are further handles of the models
    start : the model of fewer handles that the page shows before the first one; or None
    address : callable that gives the address of a model by its number
    send : callable that sends a message to the page
    """

    models: Models
    request: int
    name: str
    up: Callable[[], str]
    owners: Owners
    mirror: Callable[[PosingModel], dict[str, Any]]
    address: Callable[[int], str]
    send: Callable[[ServerMessage], None]
    kept: tuple[HandleChoice, ...] = ()
    start: PosingModel | None = None

    def __call__(self, growth: Growth, seconds: float) -> None:
        """Packs a model, and sends its address to the page."""
        model = growth.model
        assert isinstance(model, PosingModel)
        if self._has_a_better_one(growth):
            return
        same, newest = self.models.is_of(model.problem), self.models.newest
        error = None if growth.step is None else growth.step.error
        before = newest.model if newest and same else self.start
        assert before is None or isinstance(before, PosingModel)
        content = packed(
            model,
            name=self.name,
            up=self.up(),
            before=before,
            owners=self.owners(model),
            mirror=self.mirror(model),
        )
        check_stop()
        number = self.models.add(model, content, error=error)
        self.send(
            Model(
                request=self.request,
                number=number,
                address=self.address(number),
                dimension=model.dimension,
                samples=_sample_count(growth),
                error=error,
                final=growth.final,
                seconds=seconds,
                kept=self.kept,
            )
        )

    def _has_a_better_one(self, growth: Growth) -> bool:
        """Whether the page keeps its model: one of fewer handles, or of an earlier computation."""
        if growth.final:
            return False
        newest, same = self.models.newest, self.models.is_of(growth.model.problem)
        if growth.impression:
            return same or self.start is not None
        known = newest.error if newest and same else None
        return known is not None and (growth.step is None or growth.step.error > known)


def _sample_count(growth: Growth) -> int:
    """Number of samples that made or judged the model, with those of the model it started from.

    `growth.snapshots` has only the samples that were solved for it.
    """
    return len(growth.model.training_parameters) + int(growth.held_out.sum())
