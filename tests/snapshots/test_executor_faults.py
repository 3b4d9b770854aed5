"""Faults on an executor are reported in one line that names the samples."""

from __future__ import annotations

import multiprocessing
import re
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any

import numpy as np
import pytest

from .bars import posing_bar
from .blocks import DeadlyProblem, Work, backend_of
from .scripted_executor import ScriptedExecutor

KEPT = "finished samples are in the checkpoint, if there is one; the same call continues from it"


def raised_for(error: BaseException, *, size: int = 4) -> BaseException:
    """The exception that `wait` raises when the task of samples 0 to 3 fails with `error`."""
    work, executor = Work.of(posing_bar(), 4), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, size)
    executor.fail(error)
    with pytest.raises(type(error) if isinstance(error, KeyboardInterrupt) else Exception) as info:
        backend.wait(0.0)
    assert "\n" not in str(info.value)
    return info.value


@pytest.mark.parametrize("kind", [ValueError, MemoryError, RuntimeError])
def test_an_error_of_the_solve_keeps_its_kind_and_names_the_samples(kind: Any) -> None:
    cause = kind("what\nhappened")
    error = raised_for(cause)
    assert type(error) is kind
    assert str(error) == f"executor: samples 0 to 3: {kind.__name__}: what happened"
    assert error.__cause__ is cause


def test_an_internal_fault_is_not_a_value_error() -> None:
    """A ValueError would hide its traceback on the command line."""
    assert type(raised_for(ZeroDivisionError(), size=1)) is RuntimeError
    assert str(raised_for(KeyError("x"), size=1)) == "executor: sample 0: KeyError: 'x'"


def test_ctrl_c_in_a_worker_is_ctrl_c() -> None:
    interrupt = KeyboardInterrupt()
    assert raised_for(interrupt) is interrupt


def test_a_broken_pool_says_what_is_kept() -> None:
    error = raised_for(BrokenProcessPool("A process in the pool was terminated abruptly"))
    assert type(error) is ValueError
    assert "lost the worker that solved samples 0 to 3 (BrokenProcessPool: A process" in str(error)
    assert str(error).endswith(KEPT)


def test_a_worker_that_dies_breaks_its_pool_and_says_so() -> None:
    work = Work.of(posing_bar(), 8)
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        deadly: Any = DeadlyProblem()
        backend = backend_of(pool, deadly)
        backend.submit([4, 6], work.inputs[:2], work.starts[:2])
        lost = r"executor: lost the worker that solved samples 4, 6 \(BrokenProcessPool: "
        with pytest.raises(ValueError, match=lost):
            backend.wait(60.0)
        refused = r"executor: does not accept sample 5 \(BrokenProcessPool: .*" + re.escape(KEPT)
        with pytest.raises(ValueError, match=refused):
            backend.submit([5], work.inputs[:1], work.starts[:1])
        backend.close()


def test_an_executor_that_was_shut_down_takes_nothing() -> None:
    work, pool = Work.of(posing_bar(), 1), ThreadPoolExecutor(1)
    backend = backend_of(pool, work.problem)
    pool.shutdown()
    with pytest.raises(ValueError, match=r"does not accept sample 0 \(RuntimeError: cannot"):
        work.submit(backend, 1)


def test_dropped_work_is_reported() -> None:
    work, executor = Work.of(posing_bar(), 2), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, 2)
    (_, future) = executor.waiting[0]
    future.cancel()
    future.set_running_or_notify_cancel()
    with pytest.raises(ValueError, match="executor: cancelled samples 0 to 1; an executor does"):
        backend.wait(0.0)


def test_results_come_before_errors() -> None:
    work, executor = Work.of(posing_bar(), 3), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, 1)
    executor.fail(ValueError("bad"))
    executor.solve("one")
    executor.solve("one")
    assert sorted(one.sample for one in backend.wait(0.0)) == [1, 2]
    with pytest.raises(ValueError, match="sample 0: ValueError: bad"):
        backend.wait(0.0)
    assert backend.wait(0.0) == []


def test_a_problem_that_cannot_be_pickled_is_named_early() -> None:
    problem = posing_bar()
    problem.__dict__["material"] = lambda: None  # cannot be pickled
    executor: Executor = ScriptedExecutor()
    with pytest.raises(ValueError, match="executor: the problem cannot be sent to workers"):
        backend_of(executor, problem)


def test_bad_input_fails_in_the_worker_with_its_samples() -> None:
    work = Work.of(posing_bar(), 2)
    with ThreadPoolExecutor(1) as pool:
        backend = backend_of(pool, work.problem)
        backend.submit([7], np.zeros((1, 5)), work.starts[:1])
        with pytest.raises(Exception, match="executor: sample 7: "):
            backend.wait(60.0)
