"""`snapspace view` as a separate process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def served(*arguments: str | Path, cwd: Path) -> Iterator[str]:
    """The address of a page that is served until the end of the block."""
    environment = {k: v for k, v in os.environ.items() if "DISPLAY" not in k}
    process = subprocess.Popen(
        [sys.executable, "-m", "snapspace", "view", *map(str, arguments)],
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        cwd=cwd,
    )
    assert process.stderr is not None
    try:
        line = process.stderr.readline()
        assert line.startswith("snapspace: open http://127.0.0.1:"), line
        yield line.split()[2]
    finally:
        process.send_signal(signal.SIGINT)
        with process.stderr as stream:
            stream.read()
        assert process.wait(timeout=30) == 0
