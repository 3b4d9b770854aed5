"""Reporter: progress of one work, not more often than a page can show."""

from __future__ import annotations

import time
from collections.abc import Callable

from .messages import Progress

#: Seconds between two messages of the same stage.
INTERVAL = 0.1


class Reporter:
    """Tells a page how far its work is.

    Parameters
    ----------
    emit : callable
        Gets the messages.
    request : int
        Repeated in them.
    """

    def __init__(self, emit: Callable[[Progress], None], request: int) -> None:
        self._emit, self._request = emit, request
        self._begin = time.perf_counter()
        self._stage, self._told = "", 0.0

    @property
    def seconds(self) -> float:
        """Since the work began."""
        return time.perf_counter() - self._begin

    def restart(self) -> None:
        """The work begins now: it had to wait before."""
        self._begin = time.perf_counter()
        self._told = 0.0

    def tell(
        self,
        stage: str,
        done: int = 0,
        total: int = 0,
        *,
        eta: float | None = None,
        error: float | None = None,
    ) -> None:
        """Sends a message, unless one of the same stage was sent just before and this is no end."""
        now = self.seconds
        if stage == self._stage and now - self._told < INTERVAL and not 0 < total == done:
            return
        self._stage, self._told = stage, now
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
