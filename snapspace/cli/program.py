"""The program as its own process."""

from __future__ import annotations

import os
import sys
from typing import NoReturn

from ..interruptible import abandoned_work_runs
from .main import main


def program() -> NoReturn:
    """Runs `main` on the command line, and ends the process with its exit code.

    If work that Ctrl-C abandoned still runs, the process ends at once. Otherwise that work might
    return while Python shuts down; Python would end its thread inside compiled code, and that would
    kill the process by a signal.
    """
    code = main()
    if abandoned_work_runs():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)
