"""Job: long work on its own thread, which can be stopped."""

from __future__ import annotations

import threading
from collections.abc import Callable

from ..interruptible import ABANDONABLE
from ..stopping import stoppable


class Job:
    """Work that begins at once on its own thread.

    Parameters
    ----------
    work : callable
        It ends as at Ctrl-C once `stop` was called, see `stoppable`.
    failed : callable
        Called with the error if the work raises one, unless the job was stopped.
    """

    def __init__(self, work: Callable[[], None], *, failed: Callable[[Exception], None]) -> None:
        self._stop = threading.Event()
        self._work, self._failed = work, failed
        # a daemon, since compiled work that cannot be stopped must not delay the end of the program
        self._thread = threading.Thread(target=self._run, name=ABANDONABLE, daemon=True)
        self._thread.start()

    @property
    def running(self) -> bool:
        """Whether the work is still running."""
        return self._thread.is_alive()

    def stop(self) -> None:
        """Requests the end of the work, and returns at once."""
        self._stop.set()

    def wait(self, seconds: float) -> bool:
        """Waits at most this many seconds for the work to end; returns whether it has ended."""
        self._thread.join(seconds)
        return not self.running

    def _run(self) -> None:
        try:
            with stoppable(self._stop.is_set):
                self._work()
        except KeyboardInterrupt:
            pass
        except Exception as error:
            if not self._stop.is_set():
                self._failed(error)
