"""Names of temporary files, and removal of those that a dead process left behind."""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import secrets
from functools import cache, lru_cache
from pathlib import Path

_NAME = re.compile(r"\..{0,40}\.(?P<machine>[0-9a-f]{12})-(?P<process>\d{1,9})-[0-9a-f]{8}(\..*)?")


def temporary_name(path: Path) -> str:
    """A name for a temporary file beside `path`, with the extension that writers need.

    It contains the process number, so that `sweep` knows whose file it is.
    """
    mark = f"{machine_mark()}-{os.getpid()}-{secrets.token_hex(4)}"
    return f".{path.stem[:40]}.{mark}{path.suffix}"


def sweep(folder: Path) -> list[Path]:
    """Removes temporary files in a folder whose process is certainly dead, and returns them.

    A process is certainly dead if it ran after the last start of this system, would be visible
    here, and no process has its number now. Files of other machines and containers, and those
    from before the last start of the system, stay. Outside Linux nothing is removed.
    """
    removed: list[Path] = []
    if _boot() is None:
        return removed
    with contextlib.suppress(OSError):
        for path in sorted(folder.iterdir()):
            found = _NAME.fullmatch(path.name)
            if not found or found["machine"] != machine_mark() or _lives(int(found["process"])):
                continue
            with contextlib.suppress(OSError):
                path.unlink()
                removed.append(path)
    return removed


@lru_cache(maxsize=1024)
def swept_once(folder: Path) -> None:
    """Calls `sweep` the first time that this process writes to a folder."""
    sweep(folder)


@cache
def machine_mark() -> str:
    """12 hex digits that differ for other systems and containers, and after a restart.

    The mark is random if these are unknown; no later process owns files with such a mark.
    """
    known = _boot()
    content = secrets.token_bytes() if known is None else known.encode()
    return hashlib.sha256(content).hexdigest()[:12]


@cache
def _boot() -> str | None:
    """Identifies the system's start and its process namespace; None outside Linux."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
        return f"{boot} {os.readlink('/proc/self/ns/pid')}"
    except OSError:
        return None


def _lives(process: int) -> bool:
    """Whether a process has this number; it may be another one than before."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:  # the process belongs to another user
        return True
    return True
