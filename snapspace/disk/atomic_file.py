"""Writing a file so that it is either complete or not there."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from .durable import flushed_file, flushed_folder
from .temporaries import swept_once, temporary_name


@contextlib.contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Give a temporary path in the same folder; rename it to `path` when the block succeeds.

    If the block raises, or is interrupted, the temporary file is removed and a file that existed at
    `path` stays as it was. OSError (no permission, disk full) becomes ValueError with the path.
    A symbolic link is followed, so that it stays a link.

    The content is on the disk before the name is, and the name before the block is left: a power
    failure leaves the old file or the new one, and what is removed afterwards (checkpoints) is no
    longer needed. A kill can leave a temporary file; the next process that writes to the folder
    removes it, see `sweep`.
    """
    target = Path(os.path.realpath(path))
    swept_once(target.parent)
    temporary = target.with_name(temporary_name(target))
    try:
        yield temporary
        flushed_file(temporary)
        os.replace(temporary, target)
        flushed_folder(target.parent)
    except OSError as error:
        raise ValueError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
