"""A program that presses Ctrl-C in each function that a run of samples shares with its threads.

It prints a JSON object: what the run raised at each place, and what it left behind. It runs in a
separate process, because a run that waits for a lost lock or thread would block the tests.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
from types import FrameType
from typing import Any

import threadpoolctl

from snapspace import SolveProgress, interruptible, solve_snapshots
from snapspace.snapshots import run as run_of_samples

from .bars import parameters, posing_bar

#: Files of the standard library and of snapspace.
FILES = {"threading.py", "thread.py", "local_backend.py", "blas.py", "interruptible.py"}
#: After a call that takes a lock, the block that would release it has not begun yet.
EVENTS = {"call", "c_return"}
SAMPLES = 6


def place(frame: FrameType, event: str, argument: Any) -> str | None:
    """Where the program is: at the start of a function, or after a compiled one that it calls."""
    file = os.path.basename(frame.f_code.co_filename)
    if file not in FILES or event not in EVENTS:
        return None
    after = f" after {argument.__name__}" if event == "c_return" else ""
    caller = frame.f_back.f_code.co_name if frame.f_back else ""
    return f"{file}: {frame.f_code.co_name} for {caller}{after}"


def places() -> list[str]:
    """The places that an undisturbed run passes, in order, once all modules are loaded."""
    run(None)
    passed: dict[str, None] = {}

    def note(frame: FrameType, event: str, argument: Any) -> None:
        name = place(frame, event, argument)
        if name is not None:
            passed.setdefault(name)

    run(note)
    return list(passed)


def run(profile: Any) -> str:
    """Runs a new problem; returns how it ended."""
    problem = posing_bar(4, 1, 1)
    samples = parameters(problem, SAMPLES)
    sys.setprofile(profile)
    try:
        solve_snapshots(problem, samples, threads=1, progress=watch)
        return "finished"
    except BaseException as error:
        return type(error).__name__
    finally:
        sys.setprofile(None)


def watch(_: SolveProgress) -> None:
    """Makes the run estimate its error, which uses BLAS."""


def pressed_at(wanted: str) -> str | None:
    """How a run ends if Ctrl-C is pressed at a place; None if it did not pass there."""
    pressed = False

    def press(frame: FrameType, event: str, argument: Any) -> None:
        nonlocal pressed
        if place(frame, event, argument) == wanted:
            sys.setprofile(None)
            pressed = True
            signal.raise_signal(signal.SIGINT)

    outcome = run(press)
    return outcome if pressed else None


def left_threads() -> list[str]:
    """Threads that would keep the program from ending after half a second."""
    deadline = time.monotonic() + 0.5
    while True:
        others = set(threading.enumerate()) - {threading.main_thread()}
        left = [thread.name for thread in others if not thread.daemon]
        if not left or time.monotonic() > deadline:
            return left
        time.sleep(0.001)


def blas_threads() -> list[int]:
    """The thread limits of the BLAS libraries that are loaded."""
    info = threadpoolctl.threadpool_info()
    return [library["num_threads"] for library in info if library["user_api"] == "blas"]


def main() -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)
    interruptible.POLL_SECONDS = run_of_samples.POLL_SECONDS = 0.002
    names = places()
    limits = blas_threads()
    outcomes: dict[str, str | None] = {}
    left: list[str] = []
    for name in names:
        outcomes[name] = pressed_at(name)
        left = left_threads()
        if left:
            break
    results = {
        "outcomes": outcomes,
        "threads": left,
        "handler": signal.getsignal(signal.SIGINT) is signal.default_int_handler,
        "blas": blas_threads() == limits,
    }
    print(json.dumps(results), flush=True)


if __name__ == "__main__":
    main()
