"""The rates that benchmarks compare the loops with: they are possible, and the work is done."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import _core as core
from snapspace.reduction import coefficient_count

from .snapshots.bars import posing_bar


@pytest.mark.parametrize("single", [False, True])
def test_no_part_of_the_solver_beats_the_peak(single: bool) -> None:
    problem = posing_bar(12, 4, 4)
    peak = core.peak_flops(single=single, repeats=5)
    u = 0.01 * np.random.default_rng(0).normal(size=problem.base.size)
    parts = core.time_parts(problem.system, u, single=single, repeats=5)
    assert 0 < parts.kernel_flops / parts.kernel_seconds < 1.2 * peak
    single_peak = core.peak_flops(single=True, repeats=5)
    assert 0 < parts.solve_flops / parts.solve_seconds < 1.2 * single_peak


def test_single_precision_has_twice_the_peak() -> None:
    ratio = core.peak_flops(single=True) / core.peak_flops(single=False)
    assert 1.4 < ratio < 2.8


def test_reading_takes_time() -> None:
    """A loop that the compiler removed would read at any rate."""
    assert 1e8 < core.read_bandwidth(1 << 24, repeats=3) < 1e13


def test_an_evaluation_reads_all_coefficients() -> None:
    """A quartic beyond the caches is not evaluated much faster than it is read."""
    d = 60
    rng = np.random.default_rng(0)
    coefficients, q = rng.normal(size=coefficient_count(d)), rng.normal(size=d)
    bound = coefficients.nbytes / core.read_bandwidth(coefficients.nbytes, repeats=5)
    first, both = core.time_quartic(d, coefficients, q, repeats=5)
    assert 0.5 * bound < first and 0.5 * bound < both
    modes = rng.normal(size=(30, 90_000))
    bound = modes.nbytes / core.read_bandwidth(modes.nbytes, repeats=3)
    assert core.time_reconstruct(modes[0], modes, q[:30], repeats=3) > 0.5 * bound
