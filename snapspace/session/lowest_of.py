"""lowest_of: one frame, solved from several shapes."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .frame_report import FrameReport

FloatArray = NDArray[np.float64]


def lowest_of(
    loop: Any,
    solve: Callable[[], FrameReport],
    starts: Iterable[tuple[str, FloatArray]],
    resolved: float,
    value_scale: float,
) -> FrameReport:
    """Solves from each of the named starts (d,), and leaves the loop at the lowest value.

    A later one must be lower by the share `resolved` of the value, which is seen as no smaller than
    its scale. The report is that of the start that it names, with the seconds of all. Each solve
    keeps its own bounds.
    """
    begin = time.perf_counter()
    best, shape = FrameReport("not_finite", 0, 0, math.nan, math.nan, 0.0), loop.q
    for start, q in starts:
        loop.q = q
        report = solve()
        margin = resolved * (value_scale + abs(best.value))
        if not best.value - margin <= report.value:
            best, shape = replace(report, start=start), loop.q
    loop.q = shape
    return replace(best, seconds=time.perf_counter() - begin)
