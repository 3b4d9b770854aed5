"""Running compiled work so that Ctrl-C or another thread can stop it, and progress shows."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any, TypeVar

from . import _core as core
from .stopping import check_stop, ctrl_c_at_checks

POLL_SECONDS = 0.1
#: Name of the threads whose work may be abandoned.
ABANDONABLE = "abandonable"

Result = TypeVar("Result")


def run_abandonable(work: Callable[[], Result]) -> Result:
    """Calls work() on its own thread, so that Ctrl-C takes effect at once.

    For compiled work that cannot be stopped, such as a factorisation. After Ctrl-C its thread runs
    to the end in the background, and its result is lost.
    """
    return begin_abandonable(work)()


def begin_abandonable(work: Callable[[], Result]) -> Callable[[], Result]:
    """Starts the call of `run_abandonable`; the returned function waits for the result."""
    outcome: Future[Result] = Future()

    def run() -> None:
        try:
            outcome.set_result(work())
        except BaseException as error:  # raised again by `result`
            outcome.set_exception(error)

    def finish() -> Result:
        with ctrl_c_at_checks():
            while outcome not in wait([outcome], timeout=POLL_SECONDS).done:
                check_stop()
            return outcome.result()

    with ctrl_c_at_checks():
        threading.Thread(target=run, name=ABANDONABLE, daemon=True).start()
    return finish


def abandoned_work_runs() -> bool:
    """Whether any such work still runs, so that the process can end without it."""
    return any(thread.name == ABANDONABLE for thread in threading.enumerate())


def run_interruptible(
    solve: Callable[[core.SolveControl], Any],
    on_progress: Callable[[int], None],
) -> tuple[Any, bool]:
    """Calls solve(control) on its own thread.

    Returns its result, and whether Ctrl-C ended it early. `on_progress` gets the number of finished
    samples from time to time. An interrupted solve keeps the finished samples and returns early,
    with the others marked as cancelled. An exception in `on_progress` also ends the solve, and is
    raised again.
    """
    control = core.SolveControl()
    interrupted = False
    with ctrl_c_at_checks(), ThreadPoolExecutor(max_workers=1) as pool:
        future: Future[Any] = pool.submit(solve, control)
        done = False
        while not done:
            try:
                done = future in wait([future], timeout=POLL_SECONDS).done
                if not interrupted:
                    check_stop()
                    on_progress(control.finished)
            except KeyboardInterrupt:  # including one from on_progress
                interrupted = True
                control.cancel()
            except BaseException:  # from on_progress; leaving the pool would wait for all samples
                control.cancel()
                raise
    return future.result(), interrupted
