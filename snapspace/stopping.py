"""Where long work ends when it is told to: at its checks, at Ctrl-C and from other threads."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from time import monotonic
from types import FrameType

#: Ctrl-C that comes again within this time of the first one means the same.
SAME_SECONDS = 1.0

#: Raises if the work of this thread was told to stop; see `check_stop`.
_check: ContextVar[Callable[[], None]] = ContextVar("check", default=lambda: None)


class Stopped(KeyboardInterrupt):
    """Work was told to stop, as by Ctrl-C, see `stoppable`."""


def check_stop() -> None:
    """Raises KeyboardInterrupt if the work of this thread was told to stop.

    `Stopped` in a block of `stoppable`, and once for a Ctrl-C in one of `ctrl_c_at_checks`.
    """
    _check.get()()


@contextmanager
def stoppable(asked: Callable[[], bool]) -> Iterator[None]:
    """Long work in this block ends as it does at Ctrl-C, soon after `asked` says so.

    For threads other than the main one, where Ctrl-C does not arrive. What waits for compiled work
    or another process asks ten times a second, and raises `Stopped`.
    """

    def check() -> None:
        if asked():
            raise Stopped("told to stop")

    token = _check.set(check)
    try:
        yield
    finally:
        _check.reset(token)


@contextmanager
def ctrl_c_at_checks() -> Iterator[None]:
    """Ctrl-C in this block raises KeyboardInterrupt at the next `check_stop`, or at its end.

    Elsewhere Python raises it behind any call, also of a standard library that has just taken a
    lock or started a thread: whoever waits for that lock or thread then waits forever. So whatever
    shares work with threads does it in such a block, and checks ten times a second. Work that fails
    to check ends at a second Ctrl-C, a second later.

    Does nothing on other threads, inside of another such block, and for programs with their own way
    to take Ctrl-C.
    """
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    ctrl_c = _CtrlC()
    token = _check.set(ctrl_c.check)
    signal.signal(signal.SIGINT, ctrl_c.note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        _check.reset(token)
    ctrl_c.check()


@contextmanager
def ctrl_c_as_itself() -> Iterator[None]:
    """What a library has made of a KeyboardInterrupt in this block is raised as one again.

    NumPy, for instance, makes a TypeError of one that comes while it compares types.
    """
    try:
        yield
    except Exception as error:
        if _follows_ctrl_c(error):
            raise KeyboardInterrupt from error
        raise


def _follows_ctrl_c(error: BaseException | None) -> bool:
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


class _CtrlC:
    """Whether Ctrl-C was pressed, and raised."""

    def __init__(self) -> None:
        self._pressed: float | None = None
        self._raised = False

    def note(self, number: int, frame: FrameType | None) -> None:
        """A signal handler."""
        now = monotonic()
        if self._pressed is None:
            self._pressed = now
        elif now - self._pressed > SAME_SECONDS:
            signal.default_int_handler(number, frame)

    def check(self) -> None:
        """Raises once."""
        if self._pressed is not None and not self._raised:
            self._raised = True
            raise KeyboardInterrupt
