"""SharedBody: the body that all pages begin with, made when the first one asks for it."""

from __future__ import annotations

import threading
from collections.abc import Callable

from ..interruptible import POLL_SECONDS
from ..stopping import check_stop
from .body import Body

Stage = Callable[[str], None]


class SharedBody:
    """What `make` returns, made once.

    If the page that makes it is closed, or it fails, the next one that asks makes it anew.

    Parameters
    ----------
    make : callable(Stage) -> Body
        It may take minutes: filling does.
    """

    def __init__(self, make: Callable[[Stage], Body]) -> None:
        self._make = make
        self._lock = threading.Lock()
        self._body: Body | None = None

    def get(self, stage: Stage) -> Body:
        """The body.

        Parameters
        ----------
        stage : callable
            Gets what `make` tells, or "waiting" some ten times a second while another page makes
            it.

        Raises
        ------
        Stopped
            If this thread is told to stop; otherwise what `make` raises.
        """
        while not self._lock.acquire(timeout=POLL_SECONDS):
            stage("waiting")
            check_stop()
        try:
            if self._body is None:
                self._body = self._make(stage)
            return self._body
        finally:
            self._lock.release()
