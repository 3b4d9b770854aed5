"""Peak memory of this process."""

from __future__ import annotations

import sys


def peak_memory_bytes() -> int | None:
    """Largest resident size so far; None where the system does not tell (Windows)."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else 1024 * peak  # kilobytes but on macOS
