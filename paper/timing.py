"""timed: a result and the wall time that it took."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")


def timed(work: Callable[[], T]) -> tuple[T, float]:
    """The result of work(), and the seconds."""
    begin = time.perf_counter()
    result = work()
    return result, time.perf_counter() - begin
