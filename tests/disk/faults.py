"""A layer of faults under everything that writes: full disks, calls that fail, kills.

Writers use the disk in two ways. Bytes go through the system's `write`, from Python or from
libraries; the system's limit on the size of files stops them. A few calls rename and flush
(`os.replace`, `os.fsync`); they are made to fail one by one.
"""

from __future__ import annotations

import errno
import os
import resource
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NoReturn
from unittest import mock

#: Calls of `os` that `atomic_file` makes, in this order; the folder is flushed last.
CALLS = ("flush", "rename", "flush folder")


@contextmanager
def full_disk(size: int) -> Iterator[None]:
    """No file can grow beyond `size` bytes: writing more raises OSError."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, before)


@contextmanager
def at_call(number: int, fault: Callable[[], NoReturn]) -> Iterator[None]:
    """Replaces call `number` of `os.fsync` and `os.replace`, counted from 0, by `fault`."""
    made = 0

    def counted(real: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            nonlocal made
            made += 1
            if made == number + 1:
                fault()
            return real(*arguments)

        return call

    with (
        mock.patch.object(os, "fsync", counted(os.fsync)),
        mock.patch.object(os, "replace", counted(os.replace)),
    ):
        yield


def io_error() -> NoReturn:
    """The error of a broken disk."""
    raise OSError(errno.EIO, "Input/output error")


def killed() -> NoReturn:
    """Ends the process without any handler, like a power failure."""
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError("still alive")


def in_a_child(work: Callable[[], object], *, size: int | None = None) -> int:
    """Runs `work` in a fork of this process; returns the signal that killed it, 0 if none did.

    If `size` is given, the system kills it when a file grows beyond this many bytes.
    """
    child = os.fork()
    if child == 0:
        try:
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if size is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
            work()
        finally:
            os._exit(0)
    return os.WTERMSIG(os.waitpid(child, 0)[1])
