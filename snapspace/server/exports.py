"""Exports: pages in one file that a page has asked for."""

from __future__ import annotations

from ..page import packed, page_with_packed
from ..reduction import ReducedModel


class Exports:
    """Keeps the last model that a page asked to export; its page is made when it is fetched."""

    def __init__(self) -> None:
        self._last: tuple[int, str, ReducedModel] | None = None

    def keep(self, number: int, name: str, model: ReducedModel) -> None:
        """Keeps the model of a number; `name` is the heading of its page."""
        self._last = number, name, model

    def content(self, number: int) -> bytes | None:
        """The page with the model of a number; None if another one was asked for since."""
        if self._last is None or self._last[0] != number:
            return None
        _, name, model = self._last
        return page_with_packed(packed(model, name=name)).encode()

    def clear(self) -> None:
        """Drops the model."""
        self._last = None
