"""PageChannel: what a workspace tells its page, and what a page that comes back must hear again."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from .messages import Cancelled, Failed, Model, Progress, ServerMessage, Workspace

Put = Callable[..., Any]


class PageChannel:
    """Passes messages on to the page that is connected; from any thread.

    While no page is connected they are dropped, except the state that they leave behind: the
    workspace, its newest model, and how far the work is.

    Parameters
    ----------
    put : callable
        Gets messages and bytes; those of one call stay together.
    """

    def __init__(self, put: Put) -> None:
        self._put: Put | None = put
        self._lock = threading.Lock()
        self._workspace: Workspace | None = None
        self._model: Model | None = None
        self._news: Progress | Failed | None = None

    def __call__(self, *items: ServerMessage | bytes) -> None:
        """Tells the page."""
        with self._lock:
            for item in items:
                self._remember(item)
            if self._put is not None:
                self._put(*items)

    def disconnect(self) -> None:
        """The page is gone."""
        with self._lock:
            self._put = None

    def connect(self, put: Put, present: Callable[[Workspace], Workspace]) -> None:
        """A page is back: it hears the state first, and then what comes.

        Parameters
        ----------
        put : callable
            As above.
        present : callable
            Gets the workspace as it was told at first, and returns it as it is now.
        """
        with self._lock:
            self._put = put
            if self._workspace is not None:
                put(present(self._workspace))
            for item in (self._model, self._news):
                if item is not None:
                    put(item)

    def _remember(self, item: ServerMessage | bytes) -> None:
        if isinstance(item, Workspace):
            self._workspace, self._model, self._news = item, None, None
        elif isinstance(item, Model):
            self._model = item
            self._news = None if item.final else self._news
        elif isinstance(item, Progress):
            self._news = item
        elif isinstance(item, Cancelled):
            self._news = None
        elif isinstance(item, Failed) and self._news and self._news.request == item.request:
            self._news = item  # the work has ended with it
