"""lowest_of: solves one frame from several starting shapes."""

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

    A later solution replaces the best one if it is lower by more than resolved * (value_scale +
    |value|). The returned report is that of the best start, with the seconds of all solves. The
    bounds on iterations and evaluations hold for each solve.
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
