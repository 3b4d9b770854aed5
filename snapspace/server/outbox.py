"""Outbox: messages waiting to be sent to a page."""

from __future__ import annotations

import asyncio
import threading
from collections import deque

from .messages import Progress, ServerMessage

Item = ServerMessage | bytes


class Outbox:
    """A queue that any thread fills and the event loop empties.

    If a connection is slow, only the newest of a stage's waiting progress messages is kept.

    Parameters
    ----------
    loop : asyncio.AbstractEventLoop
        The loop that empties the queue.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._lock = threading.Lock()
        self._items: deque[Item] = deque()
        self._filled = asyncio.Event()

    def put(self, *items: Item) -> None:
        """Adds items, which stay together."""
        with self._lock:
            if self._items and _replaces(items[0], self._items[-1]):
                self._items.pop()
            self._items.extend(items)
        try:
            self._loop.call_soon_threadsafe(self._filled.set)
        except RuntimeError:  # the loop is closed, and so is the page
            pass

    async def get(self) -> Item:
        """The next item, once there is one."""
        while True:
            with self._lock:
                if self._items:
                    return self._items.popleft()
                self._filled.clear()
            await self._filled.wait()


def _replaces(newer: Item, older: Item) -> bool:
    """Whether the newer item makes the older one obsolete: same stage of the same work."""
    if not isinstance(newer, Progress) or not isinstance(older, Progress):
        return False
    return (newer.request, newer.stage) == (older.request, older.stage)
