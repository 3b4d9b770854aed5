"""Flushing files and folders to the disk itself, beyond the system's cache."""

from __future__ import annotations

import contextlib
import errno
import os
from pathlib import Path

# Errors of file systems without fsync, such as some network file systems.
_CANNOT = (errno.EINVAL, errno.ENOTSUP, errno.ENOSYS)


def flushed_file(path: Path) -> None:
    """Waits until the content of a file is on the disk; OSError if that fails."""
    handle = os.open(path, os.O_RDWR | getattr(os, "O_BINARY", 0))
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in _CANNOT:
            raise
    finally:
        os.close(handle)


def flushed_folder(path: Path) -> None:
    """Waits until the names in a folder are on the disk: new files, renamed and removed ones.

    It does nothing if the system does not support it (Windows) or the folder cannot be read.
    """
    if os.name == "nt":
        return
    with contextlib.suppress(OSError):
        handle = os.open(path, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
