"""SharedBody: the body that all pages begin with, made when the first page asks for it."""

from __future__ import annotations

import threading
from collections.abc import Callable

from ..interruptible import POLL_SECONDS
from ..stopping import check_stop
from .body import Body

#: Called with a stage, and where it is counted with what is done and all there is.
Stage = Callable[..., None]


class SharedBody:
    """Calls `make` once and keeps its body.

    If making it fails, or the page that makes it is closed, the next page that asks makes it again.

    Parameters
    ----------
    make : callable(Stage) -> Body
        Makes the body; filling may take minutes.
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
            Called with the stages of `make`, or with "waiting" about ten times a second while
            another page makes the body.

        Raises
        ------
        Stopped
            If this thread is asked to stop; otherwise what `make` raises.
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
