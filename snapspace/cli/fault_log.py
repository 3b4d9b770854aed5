"""A bug in snapspace itself: the traceback goes to a file, and one line to the user."""

from __future__ import annotations

import os
import platform
import shlex
import sys
import tempfile
import traceback
from collections.abc import Sequence

from .. import __version__, _core


def fault_line(error: Exception, words: Sequence[str]) -> str:
    """Writes a report with the traceback, and returns the line that names the file.

    The file is snapspace-fault-*.log in the folder for temporary files (TMPDIR, usually /tmp), new
    for each fault and readable by the user only. If it cannot be written, the traceback goes to
    standard error.

    Parameters
    ----------
    error : Exception
        The fault.
    words : sequence of str
        The arguments of the command line.
    """
    trace = "".join(traceback.format_exception(error))
    what = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    report = (
        f"snapspace {__version__}, core {_core.level}, Python {platform.python_version()}, "
        f"{platform.system()} {platform.machine()}\n"
        f"snapspace {shlex.join(words)}\n\n{trace}"
    )
    try:
        handle, path = tempfile.mkstemp(prefix="snapspace-fault-", suffix=".log", text=True)
        with os.fdopen(handle, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.write(report)
        where = f"its traceback is in {path}; please report it with that file"
    except OSError:
        sys.stderr.write(report)
        where = "its traceback is above; please report it"
    return f"error: this is a bug in snapspace, not a mistake in your input ({what}); {where}"
