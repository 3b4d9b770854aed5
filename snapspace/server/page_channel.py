"""PageChannel: messages from a workspace to its page, with the state for a page that reconnects."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from .messages import Cancelled, Failed, Model, Progress, ServerMessage, Workspace

Put = Callable[..., Any]


class PageChannel:
    """Sends messages to the connected page, from any thread.

    While no page is connected, messages are dropped, but the state is remembered: the workspace,
    its newest model, and the progress of the work.

    Parameters
    ----------
    put : callable
        Called with messages and bytes; those of one call stay together.
    """

    def __init__(self, put: Put) -> None:
        self._put: Put | None = put
        self._lock = threading.Lock()
        self._workspace: Workspace | None = None
        self._model: Model | None = None
        self._progress: Progress | Failed | None = None

    def __call__(self, *items: ServerMessage | bytes) -> None:
        """Sends items to the page."""
        with self._lock:
            for item in items:
                self._remember(item)
            if self._put is not None:
                self._put(*items)

    def disconnect(self) -> None:
        """Stops sending: the page is gone."""
        with self._lock:
            self._put = None

    def connect(self, put: Put, present: Callable[[Workspace], Workspace]) -> None:
        """Connects a page that is back; sends the state first, then new messages.

        Parameters
        ----------
        put : callable
            As above.
        present : callable
            Maps the workspace as it was first sent to its current state.
        """
        with self._lock:
            self._put = put
            if self._workspace is not None:
                put(present(self._workspace))
            for item in (self._model, self._progress):
                if item is not None:
                    put(item)

    def _remember(self, item: ServerMessage | bytes) -> None:
        if isinstance(item, Workspace):
            self._workspace, self._model, self._progress = item, None, None
        elif isinstance(item, Model):
            self._model = item
            self._progress = None if item.final else self._progress
        elif isinstance(item, Progress):
            self._progress = item
        elif isinstance(item, Cancelled):
            self._progress = None
        elif isinstance(item, Failed) and self._progress:
            if self._progress.request == item.request:
                self._progress = item  # the work has ended with it
