"""ComputationQueue: runs one computation at a time, in order of arrival."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..interruptible import POLL_SECONDS
from ..stopping import check_stop


class ComputationQueue:
    """A queue for computations that use the whole machine.

    Two computations at once would each take twice the time, and together twice the memory.
    """

    def __init__(self) -> None:
        self._queue: deque[object] = deque()
        self._changed = threading.Condition()

    @property
    def waiting(self) -> int:
        """How many computations are waiting for another one."""
        with self._changed:
            return max(len(self._queue) - 1, 0)

    @contextmanager
    def turn(self, waiting: Callable[[int], None]) -> Iterator[None]:
        """Waits until all earlier computations are done, then runs the block.

        Parameters
        ----------
        waiting : callable
            Called about ten times a second while waiting, with the number of earlier computations.

        Raises
        ------
        Stopped
            If this thread was asked to stop while it waited.
        """
        ticket = object()
        with self._changed:
            self._queue.append(ticket)
        try:
            while before := self._wait_for_earlier(ticket):
                waiting(before)
                check_stop()
            yield
        finally:
            with self._changed:
                self._queue.remove(ticket)
                self._changed.notify_all()

    def _wait_for_earlier(self, ticket: object) -> int:
        """Number of earlier ones; if there are any, waits for a change or `POLL_SECONDS`."""
        with self._changed:
            if self._queue[0] is not ticket:
                self._changed.wait(POLL_SECONDS)
            return self._queue.index(ticket)
