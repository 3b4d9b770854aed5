"""checked_threads: checks a number of threads."""

from __future__ import annotations

from .arguments import is_whole, shown

#: Largest number of threads: more are never useful, and far larger numbers do not fit in the core's
#: integers.
MOST_THREADS = 1024


def checked_threads(threads: int | None, who: str) -> int:
    """The number of threads, 0 for all; ValueError that names `who` if it is out of range."""
    if threads is None:
        return 0
    if not is_whole(threads):
        raise ValueError(f"{who}: threads is {shown(threads)}, but must be a whole number, or None")
    if not 0 <= threads <= MOST_THREADS:
        raise ValueError(
            f"{who}: threads is {threads}, but must be between 1 and {MOST_THREADS}, or None for "
            "all"
        )
    return int(threads)
