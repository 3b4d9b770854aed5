"""Stopping long work, which checks for Ctrl-C and for requests from other threads."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from time import monotonic
from types import FrameType

#: A second Ctrl-C within this time of the first one does not count.
SAME_SECONDS = 1.0

Handler = Callable[[int, FrameType | None], object]

#: Raises if the work of this thread should stop; see `check_stop`.
_check: ContextVar[Callable[[], None]] = ContextVar("check", default=lambda: None)


class Stopped(KeyboardInterrupt):
    """Work was stopped on request, as by Ctrl-C; see `stoppable`."""


class Termination:
    """A handler of SIGTERM that acts like Ctrl-C, and records that the signal was received.

    came : whether the signal was received
    """

    def __init__(self) -> None:
        self.came = False

    def __call__(self, number: int, frame: FrameType | None) -> None:
        """Raises KeyboardInterrupt."""
        self.came = True
        signal.default_int_handler(number, frame)


def check_stop() -> None:
    """Raises KeyboardInterrupt if the work of this thread should stop.

    Raises `Stopped` in a block of `stoppable`. In one of `ctrl_c_at_checks` it raises once for a
    Ctrl-C.
    """
    _check.get()()


@contextmanager
def stoppable(asked: Callable[[], bool]) -> Iterator[None]:
    """Long work in this block ends as if by Ctrl-C, soon after `asked` returns True.

    For threads other than the main one, where Ctrl-C does not arrive. Code that waits for compiled
    work or another process checks ten times a second, and raises `Stopped`.
    """

    def check() -> None:
        if asked():
            raise Stopped("asked to stop")

    token = _check.set(check)
    try:
        yield
    finally:
        _check.reset(token)


@contextmanager
def ctrl_c_at_checks() -> Iterator[None]:
    """Ctrl-C in this block raises KeyboardInterrupt at the next `check_stop`, or at its end.

    Elsewhere Python may raise it after any call, even in a standard library that has just taken a
    lock or started a thread: code that waits for that lock or thread then waits forever. So all
    code that shares work with threads uses such a block, and checks ten times a second. Work that
    fails to check ends at a second Ctrl-C at least one second later.

    The same holds for SIGTERM if its handler is a `Termination`. The block has no effect on other
    threads, inside another such block, and in programs with their own handlers of these signals.
    """
    handlers = _raising_handlers()
    if not handlers:
        yield
        return
    ctrl_c = _CtrlC(handlers)
    token = _check.set(ctrl_c.check)
    for number in handlers:
        signal.signal(number, ctrl_c.note)
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        _check.reset(token)
    ctrl_c.check()


def _raising_handlers() -> dict[int, Handler]:
    """The handlers that would raise KeyboardInterrupt on this thread, by signal."""
    if threading.current_thread() is not threading.main_thread():
        return {}
    handlers: dict[int, Handler] = {}
    for number in (signal.SIGINT, signal.SIGTERM):
        handler = signal.getsignal(number)
        if handler is signal.default_int_handler:
            handlers[number] = signal.default_int_handler
        elif isinstance(handler, Termination):
            handlers[number] = handler
    return handlers


@contextmanager
def ctrl_c_as_itself() -> Iterator[None]:
    """Restores a KeyboardInterrupt that a library in this block turned into another exception.

    NumPy, for instance, raises a TypeError if Ctrl-C comes while it compares types.
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
    """Records whether Ctrl-C was pressed, and whether it was raised."""

    def __init__(self, handlers: dict[int, Handler]) -> None:
        self._handlers = handlers
        self._pressed: float | None = None
        self._raised = False

    def note(self, number: int, frame: FrameType | None) -> None:
        """Handles the signal."""
        handler = self._handlers[number]
        if isinstance(handler, Termination):
            handler.came = True
        now = monotonic()
        if self._pressed is None:
            self._pressed = now
        elif now - self._pressed > SAME_SECONDS:
            handler(number, frame)

    def check(self) -> None:
        """Raises KeyboardInterrupt, once."""
        if self._pressed is not None and not self._raised:
            self._raised = True
            raise KeyboardInterrupt
