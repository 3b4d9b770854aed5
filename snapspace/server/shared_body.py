"""SharedBody: the initial body of all pages, made when the first page needs it."""

from __future__ import annotations

import threading
from collections.abc import Callable

from ..interruptible import POLL_SECONDS
from ..stopping import check_stop
from .body import Body
from .opening import Opening
from .user_surface import UserSurface


class SharedBody:
    """Calls `make` once and keeps its body.

    If making it fails, or the page that makes it is closed, the next page makes it again.

    Parameters
    ----------
    make : callable(Opening) -> Body
        Makes the body; filling may take minutes.
    """

    def __init__(self, make: Callable[[Opening], Body]) -> None:
        self._make = make
        self._lock = threading.Lock()
        self._surface: UserSurface | None = None  # while it is filled
        self._body: Body | None = None

    def get(self, opening: Opening) -> Body:
        """The body.

        Parameters
        ----------
        opening : Opening
            Receives the reports of `make`. While another page makes the body, it receives the
            surface, once that has been read, and the stage "waiting" about ten times a second.

        Raises
        ------
        Stopped
            If this thread is asked to stop; otherwise what `make` raises.
        """
        shown = None
        while not self._lock.acquire(timeout=POLL_SECONDS):
            if (surface := self._surface) is not shown and surface is not None:
                opening.read(surface)
                shown = surface
            opening.stage("waiting")
            check_stop()
        try:
            if self._body is None:
                self._body = self._make(Opening(opening.stage, lambda it: self._read(it, opening)))
            return self._body
        finally:
            self._surface = None
            self._lock.release()

    def _read(self, surface: UserSurface, opening: Opening) -> None:
        self._surface = surface
        opening.read(surface)
