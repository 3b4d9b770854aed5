"""Reporter: sends the progress of one computation, only as often as a page can show it."""

from __future__ import annotations

import time
from collections.abc import Callable

from .messages import Progress

#: Seconds between two messages of the same stage.
INTERVAL = 0.1


class Reporter:
    """Sends a page the progress of its work.

    Parameters
    ----------
    emit : callable
        Called with each message.
    request : int
        Number of the request, repeated in the messages.
    """

    def __init__(self, emit: Callable[[Progress], None], request: int) -> None:
        self._emit, self._request = emit, request
        self._begin = time.perf_counter()
        self._stage, self._last = "", 0.0

    @property
    def seconds(self) -> float:
        """Time since the work began."""
        return time.perf_counter() - self._begin

    def restart(self) -> None:
        """Restarts the clock: the work begins now, after waiting."""
        self._begin = time.perf_counter()
        self._last = 0.0

    def send(
        self,
        stage: str,
        done: int = 0,
        total: int = 0,
        *,
        eta: float | None = None,
        error: float | None = None,
    ) -> None:
        """Sends a message, unless one of the same stage was sent within `INTERVAL`.

        The last message of a stage, with done == total, is always sent.
        """
        now = self.seconds
        if stage == self._stage and now - self._last < INTERVAL and not 0 < total == done:
            return
        self._stage, self._last = stage, now
        self._emit(
            Progress(
                request=self._request,
                stage=stage,
                done=done,
                total=total,
                seconds=now,
                eta=eta,
                error=error,
            )
        )
