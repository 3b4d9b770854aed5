"""Finished samples to store, with arbitrary numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace import SampleReport

FloatArray = NDArray[np.float64]


def displacements(count: int, size: int, *, seed: int = 0) -> FloatArray:
    return np.random.default_rng(seed).normal(size=(count, size))


def report(index: int) -> SampleReport:
    """A report that differs from all others, with numbers that JSON must not round."""
    return SampleReport(
        status="converged",
        iterations=index,
        evaluations=index + 1,
        value=1.0 / (index + 3),
        gradient_norm=1e-300,
        decrement=-0.0,
        seconds=0.1 * index,
        inverted_tets=0,
    )
