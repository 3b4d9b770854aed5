"""Files that are complete or absent, even after a full disk, a kill or a power failure."""

from .atomic_file import atomic_file
from .checked_file import ChangedFileError, read_checked, write_checked
from .durable import flushed_file, flushed_folder
from .temporaries import sweep

__all__ = [
    "ChangedFileError",
    "atomic_file",
    "flushed_file",
    "flushed_folder",
    "read_checked",
    "sweep",
    "write_checked",
]
