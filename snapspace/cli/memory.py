"""Peak memory of this process."""

from __future__ import annotations

import sys


def peak_memory_bytes() -> int | None:
    """Largest resident size so far; None if the system does not report it (Windows)."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else 1024 * peak  # in bytes on macOS, else in kB
