"""Root finding: zeros of an implicit function on many segments at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ImplicitFunction = Callable[[FloatArray], FloatArray]
#: Called with two numbers: done and in all.
Counter = Callable[[int, int], None]

_CHUNK = 1 << 15  # points per call: keeps the temporaries of the implicit function in cache
_STEPS = 12  # each step of the Illinois method multiplies the correct digits by about 1.44


def evaluate(
    implicit: ImplicitFunction, points: FloatArray, counter: Counter | None = None
) -> FloatArray:
    """Call `implicit` on points (k, 3) piece by piece; ValueError if the result is invalid.

    `counter` counts the points.
    """
    values = np.empty(len(points))
    for start in range(0, len(points), _CHUNK):
        piece = points[start : start + _CHUNK]
        answer = np.asarray(implicit(piece), dtype=np.float64)
        if answer.shape != (len(piece),):
            raise ValueError(
                f"stuff: implicit returned shape {answer.shape} for {len(piece)} points,"
                f" but must return ({len(piece)},)"
            )
        values[start : start + _CHUNK] = answer
        if counter is not None:
            counter(start + len(piece), len(points))
    if not np.isfinite(values).all():
        bad = int(np.flatnonzero(~np.isfinite(values))[0])
        raise ValueError(
            f"stuff: implicit is {values[bad]} at {points[bad].tolist()}, but must be finite"
        )
    return values


def zero_fractions(
    implicit: ImplicitFunction,
    start: FloatArray,
    end: FloatArray,
    start_value: FloatArray,
    end_value: FloatArray,
    counter: Counter | None = None,
) -> FloatArray:
    """Find t with implicit(start + t (end - start)) = 0 on segments whose ends differ in sign.

    It takes a fixed number of steps of the Illinois variant of regula falsi (Dowell & Jarratt
    1971), which never leaves the segment. The ends are used in the caller's order, so mirrored
    segments of a mirrored function give bitwise the same fractions.

    Parameters
    ----------
    start, end : ndarray, (k, 3)
    start_value, end_value : ndarray, (k,)
        Values at the ends, of strictly opposite sign.
    counter : callable, optional
        Counts the steps.

    Returns
    -------
    ndarray, (k,)
        Fractions, strictly between 0 and 1.
    """
    # (a, fa) is the older end of the bracket and (b, fb) the newest point.
    a, b = np.zeros(len(start)), np.ones(len(start))
    fa, fb = start_value.copy(), end_value.copy()
    best, best_value = np.full(len(start), 0.5), np.full(len(start), np.inf)
    for step in range(_STEPS):
        # fa and fb keep strictly opposite signs until fb is exactly zero: then t stays at b.
        t = b - fb * (b - a) / (fb - fa)
        ft = evaluate(implicit, start + t[:, None] * (end - start))
        better = abs(ft) < best_value
        best, best_value = np.where(better, t, best), np.where(better, abs(ft), best_value)
        crossed = np.sign(ft) != np.sign(fb)
        a, fa = np.where(crossed, b, a), np.where(crossed, fb, 0.5 * fa)
        b, fb = t, ft
        if counter is not None:
            counter(step + 1, _STEPS)
        if not np.any(fb):
            break
    tiny = np.finfo(np.float64).eps
    return np.asarray(np.clip(best, tiny, 1.0 - tiny))
