"""Threads that share a queue: bitwise as in one call, each sample once, and all threads end."""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from snapspace import InterpolationProblem, PosingProblem
from snapspace.problem import Problem, solver_traits
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.local_backend import LocalBackend
from snapspace.snapshots.solver_options import ResolvedOptions, Solver

from ..shapes import interpolation_problem
from .bars import posing_bar
from .blocks import OPTIONS, Outcome, Work, assert_same_outcomes, outcomes

PATIENCE = 20.0  # seconds that a test waits for a thread before it fails
COUNT = 19
# wide enough for refused steps, restarts and inverted tets: paths differ from sample to sample
WORK = Work.of(posing_bar(6, 2, 2, bound=0.7), COUNT)
# hours of work unless it is cancelled
ENDLESS = replace(OPTIONS, solver="newton", tolerance=1e-300, max_iterations=10**9)


@pytest.fixture(scope="module")
def expected() -> dict[Solver, dict[int, Outcome]]:
    return {solver: WORK.solved_here(replace(OPTIONS, solver=solver)) for solver in SOLVERS}


@contextmanager
def backend_for(
    problem: Problem, options: ResolvedOptions, *, expected: int, threads: int = 1
) -> Iterator[LocalBackend]:
    """A backend that is closed after the test, and then has no threads left."""
    before = set(threading.enumerate())
    backend = LocalBackend(problem, options, expected=expected, threads=threads)
    try:
        yield backend
    finally:
        backend.close()
    assert set(threading.enumerate()) <= before


def submit(backend: LocalBackend, work: Work, samples: list[int]) -> None:
    backend.submit(samples, work.inputs[samples], work.starts[samples])


def collected(backend: LocalBackend, count: int) -> dict[int, Outcome]:
    """Waits for `count` samples, each once."""
    found: dict[int, Outcome] = {}
    end = time.monotonic() + PATIENCE
    while len(found) < count:
        assert time.monotonic() < end, f"only {len(found)} of {count} samples came back"
        fresh = outcomes(backend.wait(0.05))
        assert not set(fresh) & set(found), "a sample came back twice"
        found.update(fresh)
    return found


@pytest.mark.parametrize("solver", SOLVERS)
@settings(max_examples=12)
@given(seed=st.integers(0, 2**32), threads=st.integers(1, 4), missing=st.integers(0, 10))
def test_samples_in_any_order_and_portions_are_bitwise_those_of_one_call(
    expected: dict[Solver, dict[int, Outcome]],
    solver: Solver,
    seed: int,
    threads: int,
    missing: int,
) -> None:
    """The expected number may be wrong; it only determines the number of threads."""
    order = random.Random(seed)
    left, found = order.sample(range(COUNT), COUNT), dict[int, Outcome]()
    options = replace(OPTIONS, solver=solver)
    with backend_for(WORK.problem, options, expected=COUNT - missing, threads=threads) as backend:
        while left:
            some, left = left[: (size := order.randint(1, COUNT))], left[size:]
            submit(backend, WORK, some)
            if order.random() < 0.5:
                found.update(collected(backend, len(some)))
        found.update(collected(backend, COUNT - len(found)))
        assert backend.wait(0.0) == []
    assert_same_outcomes(found, expected[solver])


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_thread_waits_for_samples_that_come_later(solver: Solver) -> None:
    """A block may have to wait for another one, and meanwhile no thread has work."""
    options = replace(OPTIONS, solver=solver)
    with backend_for(WORK.problem, options, expected=COUNT, threads=3) as backend:
        for some in ([4], [2, 9, 11], [0]):
            begin = time.perf_counter()
            assert backend.wait(0.03) == []
            assert 0.02 < time.perf_counter() - begin < 5.0, "it returns after the timeout"
            submit(backend, WORK, some)
            assert sorted(collected(backend, len(some))) == sorted(some)


def test_there_may_be_more_threads_than_samples(
    expected: dict[Solver, dict[int, Outcome]],
) -> None:
    with backend_for(WORK.problem, OPTIONS, expected=1, threads=8) as backend:
        submit(backend, WORK, [7])
        assert_same_outcomes(collected(backend, 1), {7: expected["fast"][7]})


@pytest.mark.parametrize("solver", SOLVERS)
def test_cancel_ends_the_solves_soon(solver: Solver) -> None:
    work = Work.of(posing_bar(12, 4, 4, bound=0.7), 12)
    options = replace(ENDLESS, solver=solver)
    with backend_for(work.problem, options, expected=12, threads=2) as backend:
        submit(backend, work, list(range(12)))
        found = outcomes(backend.wait(0.05))
        begin = time.perf_counter()
        backend.cancel()
        assert time.perf_counter() - begin < 0.5
        found.update(outcomes(backend.wait(0.0)))
    assert time.perf_counter() - begin < 2.0
    assert len(found) < 12
    assert all(report.status != "cancelled" for _, report in found.values())


def test_finished_samples_survive_cancel() -> None:
    with backend_for(WORK.problem, OPTIONS, expected=COUNT) as backend:
        submit(backend, WORK, [1, 2, 3])
        end = time.monotonic() + PATIENCE
        while backend._control.finished < 3:
            assert time.monotonic() < end
            time.sleep(0.001)
        backend.cancel()
        assert sorted(outcomes(backend.wait(0.0))) == [1, 2, 3]


class SlowToCompile(PosingProblem):
    """Counts its compilations; from Python 3.12 on cached properties have no lock."""

    compiled = 0

    @property
    def system(self) -> Any:  # type: ignore[override]
        if "kept" not in self.__dict__:
            self.compiled += 1
            time.sleep(0.05)
            self.__dict__["kept"] = super().system
        return self.__dict__["kept"]


def test_the_problem_is_compiled_once() -> None:
    """A factor may take minutes and most of the memory, and two threads need it at once."""
    bar = posing_bar(6, 2, 2)
    problem = SlowToCompile(bar.mesh, bar.handles, domain=bar.domain)
    with backend_for(problem, OPTIONS, expected=2) as backend:
        submit(backend, WORK, [0, 1])
        collected(backend, 2)
    assert problem.compiled == 1


def test_closing_without_any_sample_and_twice_is_fine() -> None:
    with backend_for(WORK.problem, OPTIONS, expected=5, threads=2) as backend:
        backend.close()


def test_an_error_of_the_solver_reaches_the_caller() -> None:
    """Otherwise the caller would wait forever."""

    def fail(*_: Any, **__: Any) -> None:
        raise MemoryError("no memory for the pairs")

    problem: PosingProblem = posing_bar(6, 2, 2)
    system = problem.system
    problem.__dict__["system"] = SimpleNamespace(put=system.put, serve_fast=fail)
    with backend_for(problem, OPTIONS, expected=2) as backend:
        submit(backend, WORK, [0, 1])
        with pytest.raises(MemoryError, match="no memory"):
            for _ in range(100):
                backend.wait(0.05)


@pytest.mark.parametrize(("inputs", "starts"), [(5, 189), (54, 188)])
def test_samples_of_another_size_are_refused(inputs: int, starts: int) -> None:
    sizes = WORK.inputs.shape[1], WORK.starts.shape[1]
    assert sizes == (54, 189)
    with backend_for(WORK.problem, OPTIONS, expected=1) as backend:
        with pytest.raises(ValueError, match=r"must be \((input_size|3n),\)"):
            backend.submit([0], np.zeros((1, inputs)), np.zeros((1, starts)))


@pytest.mark.parametrize("threads", [1, 3])
def test_slow_samples_continue_alone_and_are_returned_once(
    monkeypatch: pytest.MonkeyPatch, threads: int
) -> None:
    """Others are still being solved; the bits are those of one call."""
    monkeypatch.setattr(solver_traits, "PATIENCE", 17)
    work = Work.of(interpolation_problem(), 9)
    with backend_for(work.problem, OPTIONS, expected=9, threads=threads) as backend:
        for some in ([0, 1, 2, 3], [4, 5], [6, 7, 8]):
            submit(backend, work, some)
        found = collected(backend, 9)
        assert backend.wait(0.0) == []
    here = work.solved_here()
    assert max(report.iterations for _, report in here.values()) > 2 * 17
    assert_same_outcomes(found, here)


def test_cancel_in_a_second_try_returns_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sample that has used up its patience is not finished."""
    monkeypatch.setattr(solver_traits, "PATIENCE", 3)
    work = Work.of(interpolation_problem(), 4)
    started, proceed = threading.Event(), threading.Event()
    near = InterpolationProblem._system_near
    _ = work.problem.system  # the same method makes it

    def slow(problem: InterpolationProblem, displacement: Any) -> Any:
        started.set()
        assert proceed.wait(PATIENCE)
        return near(problem, displacement)

    monkeypatch.setattr(InterpolationProblem, "_system_near", slow)
    with backend_for(work.problem, OPTIONS, expected=4) as backend:
        submit(backend, work, [0, 1, 2, 3])
        end = time.monotonic() + PATIENCE
        while not started.is_set():
            assert backend.wait(0.02) == [] and time.monotonic() < end
        backend.cancel()
        proceed.set()
        for _ in range(10):
            assert backend.wait(0.01) == []
