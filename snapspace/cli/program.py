"""The program as a process of its own."""

from __future__ import annotations

import os
import sys
from typing import NoReturn

from ..interruptible import abandoned_work_runs
from .main import main


def program() -> NoReturn:
    """Runs `main` on the words of the command line and ends the process with its exit code.

    At once if work still runs that Ctrl-C has left alone. If it came back while Python shuts down,
    Python would end its thread inside of compiled code, and with that the process by a signal.
    """
    code = main()
    if abandoned_work_runs():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)
