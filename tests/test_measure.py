"""The rates that benchmarks compare the loops with: they are possible, and the work is done."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from snapspace import _core as core
from snapspace.reduction import coefficient_count

from .snapshots.bars import posing_bar


def shortest(measure: Callable[[], list[float]]) -> np.ndarray:
    """The shortest of ten times of each loop, measured in turn.

    Others may use the processor and the memory meanwhile: one loop after the other, a disturbance
    could last through all repetitions of the first and be gone for the second.
    """
    return np.min([measure() for _ in range(10)], axis=0)


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
    seconds_of_a_flop = shortest(
        lambda: [1.0 / core.peak_flops(single=single, repeats=1) for single in (False, True)]
    )
    assert 1.4 < seconds_of_a_flop[0] / seconds_of_a_flop[1] < 2.8


def test_reading_takes_time() -> None:
    """A loop that the compiler removed would read at any rate."""
    assert 1e8 < core.read_bandwidth(1 << 24, repeats=3) < 1e13


def test_an_evaluation_reads_all_coefficients() -> None:
    """A quartic beyond the caches is not evaluated much faster than it is read."""
    d = 60
    rng = np.random.default_rng(0)
    coefficients, q = rng.normal(size=coefficient_count(d)), rng.normal(size=d)

    def quartic() -> list[float]:
        first, both = core.time_quartic(d, coefficients, q, repeats=1)
        reading = coefficients.nbytes / core.read_bandwidth(coefficients.nbytes, repeats=1)
        return [first, both, reading]

    first, both, reading = shortest(quartic)
    assert 0.5 * reading < first and 0.5 * reading < both


def test_a_shape_reads_all_modes() -> None:
    """Modes beyond the caches are not added up much faster than they are read."""
    rng = np.random.default_rng(0)
    q, modes = rng.normal(size=30), rng.normal(size=(30, 90_000))

    def reconstruction() -> list[float]:
        seconds = core.time_reconstruct(modes[0], modes, q, repeats=1)
        reading = modes.nbytes / core.read_bandwidth(modes.nbytes, repeats=1)
        return [seconds, reading]

    seconds, reading = shortest(reconstruction)
    assert 0.5 * reading < seconds
