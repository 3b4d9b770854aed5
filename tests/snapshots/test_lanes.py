"""A sample depends neither on its neighbours nor on earlier samples of its lane."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import SolverOptions, solve_snapshots
from snapspace import _core as core

from .bars import assert_same_bits, parameters, posing_bar

FloatArray = NDArray[np.float64]

PROBLEM = posing_bar(6, 2, 2, bound=0.7)
COUNT = 20
INPUTS = PROBLEM.inputs(parameters(PROBLEM, COUNT))
#: paths of different lengths
STARTS = 0.1 * np.outer(np.linspace(-1, 1, COUNT), np.sin(np.arange(PROBLEM.base.size)))
WIDTHS = [(2, True), (4, True), (8, True), (16, True), (2, False), (4, False), (8, False)]
per_width = pytest.mark.parametrize(("lanes", "single"), WIDTHS)

Bits = tuple[bytes, str, int, int, float, float, float]


def solve(
    inputs: FloatArray, starts: FloatArray, lanes: int, single: bool, *, threads: int = 1
) -> list[Bits]:
    """All results of each sample, except the wall time."""
    batch = PROBLEM.system.solve_fast(
        inputs,
        starts,
        tolerance=1e-5,
        max_iterations=300,
        threads=threads,
        control=core.SolveControl(),
        lanes=lanes,
        single=single,
    )
    return [
        (
            # adding zero makes -0.0 and 0.0 the same
            (shape + 0.0).tobytes(),
            report.status.name,
            report.iterations,
            report.evaluations,
            report.value,
            report.gradient_norm,
            report.decrement,
        )
        for shape, report in zip(batch.shapes, batch.reports, strict=True)
    ]


@pytest.fixture(scope="module")
def alone() -> dict[bool, list[Bits]]:
    """Each sample in its own pack, in single and in double precision."""
    return {
        single: [solve(INPUTS[[k]], STARTS[[k]], 2, single)[0] for k in range(COUNT)]
        for single in (True, False)
    }


@per_width
@settings(max_examples=10)
@given(
    which=st.lists(st.integers(0, COUNT - 1), min_size=1, max_size=30),
    threads=st.integers(1, 3),
)
def test_neighbours_threads_and_widths_do_not_change_a_bit(
    alone: Any, lanes: int, single: bool, which: list[int], threads: int
) -> None:
    together = solve(INPUTS[which], STARTS[which], lanes, single, threads=threads)
    assert together == [alone[single][k] for k in which]


def test_the_paths_differ(alone: Any) -> None:
    """Otherwise the tests above and below would mean little."""
    assert len({bits[3] for bits in alone[True]}) > 5


#: Samples that end as not_finite: at once, with an infinite shape, or by gradient overflow.
SPOILT = {
    "target": (1e200, 0.0),
    "start": (1.0, 1e12),
    "infinite start": (1.0, 1e80),
    "gradient": (1.0, 1e66),
    "nan": (np.nan, 0.0),
}


def spoilt(kind: str) -> tuple[FloatArray, FloatArray]:
    """Input and start of a sample that is not finite in at least one of the two precisions."""
    factor, size = SPOILT[kind]
    noise = np.random.default_rng(0).normal(size=PROBLEM.base.size)
    return factor * INPUTS[[0]], size * noise[None]


@per_width
@pytest.mark.parametrize("kind", list(SPOILT))
def test_a_lane_forgets_a_sample_that_was_not_finite(
    alone: Any, lanes: int, single: bool, kind: str
) -> None:
    """The first samples of all lanes end at once, and the next ones take their lanes."""
    w, start = spoilt(kind)
    inputs = np.vstack([np.repeat(w, lanes, axis=0), INPUTS, w, INPUTS])
    starts = np.vstack([np.repeat(start, lanes, axis=0), STARTS, start, STARTS])
    bits = solve(inputs, starts, lanes, single)
    status = bits[0][1]
    assert status == "not_finite" or (not single and kind == "start")
    assert bits[lanes : lanes + COUNT] == alone[single]
    assert bits[lanes + COUNT + 1 :] == alone[single]


@pytest.mark.parametrize(("lanes", "single"), [(8, True), (8, False)])
@pytest.mark.parametrize("kind", list(SPOILT))
def test_a_sample_that_is_not_finite_has_the_same_report_in_any_lane(
    lanes: int, single: bool, kind: str
) -> None:
    """The samples that the lane solved before do not matter."""
    w, start = spoilt(kind)
    expected = solve(w, start, lanes, single)[0]
    after = solve(np.vstack([INPUTS, w]), np.vstack([STARTS, start]), lanes, single)[-1]
    np.testing.assert_equal(after[1:], expected[1:])


@pytest.mark.parametrize("samples", [7, 20, 30])
def test_threads_and_executors_do_not_change_a_bit_of_snapshots(samples: int) -> None:
    """Packs have several widths, and starts come from earlier blocks."""
    problem, options = PROBLEM, SolverOptions(precision="single", block=4)
    assert options.resolved(problem).single
    w = parameters(problem, samples)
    one, three = (solve_snapshots(problem, w, options=options, threads=n) for n in (1, 3))
    with ThreadPoolExecutor(2) as pool:
        elsewhere = solve_snapshots(problem, w, options=options, executor=pool)
    assert_same_bits(three, one)
    assert_same_bits(elsewhere, one)
