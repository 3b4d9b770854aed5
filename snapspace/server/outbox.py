"""Outbox: messages on their way to a page."""

from __future__ import annotations

import asyncio
import threading
from collections import deque

from .messages import Progress, ServerMessage

Item = ServerMessage | bytes


class Outbox:
    """A queue that any thread fills and the event loop empties.

    Of a stage's progress that a slow connection has not taken yet only the newest is kept.

    Parameters
    ----------
    loop : asyncio.AbstractEventLoop
        The one that empties it.
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
    """Whether nobody needs the older one any more: both tell of the same stage of the same work."""
    if not isinstance(newer, Progress) or not isinstance(older, Progress):
        return False
    return (newer.request, newer.stage) == (older.request, older.stage)
