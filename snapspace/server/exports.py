"""Exports: pages in one file that a page has requested."""

from __future__ import annotations

from ..page import packed, page_with_packed
from ..reduction import ReducedModel
from .body_session import BodySession
from .messages import Export
from .models import Models
from .recorded import recorded


class Exports:
    """Stores the last model that a page asked to export; its page is made when it is fetched."""

    def __init__(self) -> None:
        self._last: tuple[int, str, ReducedModel] | None = None

    def keep(
        self, order: Export, models: Models, session: BodySession | None, *, title: str
    ) -> None:
        """Stores the model of an order, with the work of its page.

        Parameters
        ----------
        order : Export
        models : Models
        session : BodySession or None
            Session of the body whose handles are chosen.
        title : str
            Heading of the page without a session; otherwise the name of the body is used.

        Raises
        ------
        ValueError
            If the model is no longer kept, or for an invalid timeline.
        """
        model, name = models.get(order.model), title
        if session is None:
            model = recorded(model, up=order.up, timeline=order.timeline)
        else:
            model, name = session.recorded(model, order), session.body.name
        self._last = order.model, name, model

    def content(self, number: int) -> bytes | None:
        """The page with the model of this number; None if another one was requested since."""
        if self._last is None or self._last[0] != number:
            return None
        _, name, model = self._last
        return page_with_packed(packed(model, name=name)).encode()

    def clear(self) -> None:
        """Drops the model."""
        self._last = None
