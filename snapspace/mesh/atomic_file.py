"""Writing a file so that it is either complete or not there."""

from __future__ import annotations

import contextlib
import os
import secrets
from collections.abc import Iterator
from pathlib import Path


@contextlib.contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Give a temporary path in the same folder; rename it to `path` when the block succeeds.

    If the block raises, or is interrupted, the temporary file is removed and a file that existed at
    `path` stays as it was. OSError (no permission, disk full) becomes ValueError with the path.
    A symbolic link is followed, so that it stays a link.
    """
    target = Path(os.path.realpath(path))
    # the extension stays: writers look at it
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}{target.suffix}")
    try:
        yield temporary
        os.replace(temporary, target)
    except OSError as error:
        raise ValueError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
