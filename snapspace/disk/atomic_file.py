"""Writing a file so that it is either complete or absent."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from .durable import flushed_file, flushed_folder
from .temporaries import swept_once, temporary_name


@contextlib.contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Yields a temporary path in the same folder; renames it to `path` if the block succeeds.

    If the block raises, or is interrupted, the temporary file is removed and an existing file at
    `path` stays as it was. OSError (no permission, disk full) becomes ValueError with the path.
    A symbolic link is followed, so that it stays a link.

    The content reaches the disk before the name does, and the name before the block ends. So a
    power failure leaves the old file or the new one, and files that are removed after the block
    (checkpoints) are no longer needed. A kill can leave a temporary file; the next process that
    writes to the folder removes it, see `sweep`.
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
