"""Running compiled work so that Ctrl-C, or another thread, ends it and progress shows."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

from . import _core as core

POLL_SECONDS = 0.1

Result = TypeVar("Result")

#: Of the block that this thread is in; see `stoppable`.
_asked: ContextVar[Callable[[], bool]] = ContextVar("asked", default=lambda: False)


class Stopped(KeyboardInterrupt):
    """Work was told to stop, as by Ctrl-C, see `stoppable`."""


@contextmanager
def stoppable(asked: Callable[[], bool]) -> Iterator[None]:
    """Long work in this block ends as it does at Ctrl-C, soon after `asked` says so.

    For threads other than the main one, where Ctrl-C does not arrive. What waits for compiled work
    or another process asks ten times a second, and raises `Stopped`.
    """
    token = _asked.set(asked)
    try:
        yield
    finally:
        _asked.reset(token)


def check_stop() -> None:
    """Raises `Stopped` if the work of this thread was told to stop."""
    if _asked.get()():
        raise Stopped("told to stop")


def run_abandonable(work: Callable[[], Result]) -> Result:
    """Calls work() on a thread of its own, so that Ctrl-C is answered at once.

    For compiled work without a way to tell it to stop, such as a factorisation. On Ctrl-C its
    thread is left alone until it is done, and what it finds is lost.
    """
    return begin_abandonable(work)()


def begin_abandonable(work: Callable[[], Result]) -> Callable[[], Result]:
    """As `run_abandonable`, in two parts: calling what is returned waits for the work."""
    outcome: Future[Result] = Future()

    def run() -> None:
        try:
            outcome.set_result(work())
        except BaseException as error:  # raised again by `result`
            outcome.set_exception(error)

    def finish() -> Result:
        while outcome not in wait([outcome], timeout=POLL_SECONDS).done:
            check_stop()
        return outcome.result()

    threading.Thread(target=run, daemon=True).start()
    return finish


def run_interruptible(
    solve: Callable[[core.SolveControl], Any],
    on_progress: Callable[[int], None],
) -> tuple[Any, bool]:
    """Calls solve(control) on a thread of its own.

    Returns its result, and whether Ctrl-C ended it early. `on_progress` gets the number of
    finished samples now and then. The solve keeps what it finished: an interrupted one returns
    early with the rest marked cancelled. What `on_progress` raises ends the solve as well, and is
    passed on.
    """
    control = core.SolveControl()
    interrupted = False
    with ThreadPoolExecutor(max_workers=1) as pool:
        future: Future[Any] = pool.submit(solve, control)
        done = False
        while not done:
            try:
                done = future in wait([future], timeout=POLL_SECONDS).done
                if not interrupted:
                    check_stop()
                    on_progress(control.finished)
            except KeyboardInterrupt:  # also one that arrives while progress is drawn
                interrupted = True
                control.cancel()
            except BaseException:  # of on_progress: leaving the pool would wait for all samples
                control.cancel()
                raise
    return future.result(), interrupted
