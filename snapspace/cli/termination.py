"""SIGTERM, which job schedulers and `kill` send, ends a command as Ctrl-C does."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from ..stopping import Termination


@contextmanager
def terminated_as_interrupted() -> Iterator[Termination]:
    """In this block SIGTERM raises KeyboardInterrupt; the result says whether it was received.

    It does nothing on threads other than the main one, or if the signal is ignored or handled
    already.
    """
    termination = Termination()
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield termination
        return
    signal.signal(signal.SIGTERM, termination)
    try:
        yield termination
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
