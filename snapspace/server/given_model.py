"""GivenModel: the model that a page's body comes from, which the page can show again."""

from __future__ import annotations

from collections.abc import Callable

from ..page import packed
from ..reduction import ReducedModel
from .body import Body
from .messages import Model
from .models import Models


class GivenModel:
    """Gives a page the model of its body, if any, until another one is computed.

    Parameters
    ----------
    body : Body
    """

    def __init__(self, body: Body) -> None:
        self._name, self._model = body.name, body.model
        self._content = b""

    def pack(self) -> None:
        """Packs the model, unless it is packed already; this takes a moment."""
        if self._model is not None and not self._content:
            self._content = packed(self._model, name=self._name)

    def give(self, models: Models, *, address: Callable[[int], str]) -> tuple[Model, ...]:
        """Adds the model to those of the page.

        Parameters
        ----------
        models : Models
            The page's models.
        address : callable
            Gives the address of a model by its number.

        Returns
        -------
        tuple of Model
            The message that tells the page where the model is; empty without one.
        """
        model = self._model
        if model is None:
            return ()
        self.pack()
        number = models.add(model, self._content, error=_error_of(model))
        message = Model(
            request=0,
            number=number,
            address=address(number),
            dimension=model.dimension,
            samples=len(model.training_parameters),
            error=None,
            final=True,
            seconds=0.0,
        )
        return (message,)


def _error_of(model: ReducedModel) -> float | None:
    """The error that was measured when the model was built, as its provenance has it."""
    record = model.provenance.get("accurate")
    step = record.get("step") if isinstance(record, dict) else None
    error = step.get("error") if isinstance(step, dict) else None
    return error if isinstance(error, float) else None
