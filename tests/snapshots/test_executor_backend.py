"""Blocks on an executor: bitwise as in a local run, one copy of the problem, nothing lost."""

from __future__ import annotations

import gc
import pickle
import time
import weakref
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from snapspace.problem import solver_traits
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.held_problems import HeldProblem, HeldProblems
from snapspace.snapshots.solver_options import Solver

from ..shapes import interpolation_problem
from .bars import posing_bar
from .blocks import OPTIONS, Work, assert_same_outcomes, backend_of, collected, outcomes, sent_once
from .conftest import WORKERS, WORKERS_PATIENCE
from .scripted_executor import ScriptedExecutor


@pytest.fixture(scope="module")
def work() -> Work:
    # wide enough for refused steps, restarts and inverted tets: paths differ from sample to sample
    return Work.of(posing_bar(bound=0.7), 22)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("size", [1, 5, 8])
def test_threads_give_bitwise_the_results_of_one_call(
    work: Work, solver: Solver, size: int
) -> None:
    """Any division of the samples into blocks and packs gives them."""
    options = replace(OPTIONS, solver=solver)
    with ThreadPoolExecutor(3) as pool:
        backend = backend_of(pool, work.problem, options)
        work.submit(backend, size)
        found = collected(backend, 22)
        assert backend.payloads_sent == 0, "threads share the problem"
        assert backend.wait(5.0) == []
        backend.close()
    assert_same_outcomes(found, work.solved_here(options))


@pytest.mark.parametrize("solver", SOLVERS)
def test_processes_give_the_same_bits(
    processes: ProcessPoolExecutor, work: Work, solver: Solver
) -> None:
    options = replace(OPTIONS, solver=solver)
    backend = backend_of(processes, work.problem, options)
    work.submit(backend, 5)
    assert_same_outcomes(collected(backend, 22), work.solved_here(options))


def test_the_mean_shape_is_sent_with_an_interpolation(
    processes: ProcessPoolExecutor, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Slow samples get their own factor in workers too."""
    monkeypatch.setattr(solver_traits, "PATIENCE", WORKERS_PATIENCE)
    work = Work.of(interpolation_problem(), 6)
    backend = backend_of(processes, work.problem)
    work.submit(backend, 3)
    here = work.solved_here()
    assert all(report.iterations > WORKERS_PATIENCE for _, report in here.values())
    assert_same_outcomes(collected(backend, 6), here)


def test_the_problem_is_sent_once_per_process(
    processes: ProcessPoolExecutor, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither later blocks nor a later run on the same problem send it again."""
    problem, equal = (posing_bar(16, 3, 3, bound=0.3) for _ in range(2))
    with monkeypatch.context() as patch:
        sent_once(processes, problem, WORKERS, patch)
    work, later = Work.of(equal, 24), backend_of(processes, equal)
    work.submit(later, 2)
    collected(later, 24)
    assert later.payloads_sent == 0


def test_blocks_wait_while_the_problem_is_being_sent() -> None:
    work, executor = Work.of(posing_bar(), 10), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, 1)
    assert all(task.payload is None for task in executor.tasks)
    executor.need_the_problem("one", 4)
    executor.need_the_problem("two", 6)
    assert backend.wait(0.0) == []
    assert backend.payloads_sent == WORKERS
    carriers = executor.tasks
    assert len(carriers) == WORKERS
    assert all(task.payload is not None for task in carriers)
    executor.solve("one")
    assert [one.sample for one in backend.wait(0.0)] == list(carriers[0].samples)
    # the other task with the problem, then all tasks without it
    assert [task.payload is None for task in executor.tasks] == [False] + [True] * 8
    while executor.tasks:
        executor.solve("one")
    assert len(backend.wait(0.0)) == 9
    assert backend.payloads_sent == WORKERS


def test_no_two_tasks_are_equal() -> None:
    """Dask merges equal calls: a block that is sent again would get its old answer."""
    work, executor = Work.of(posing_bar(), 1), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, 1)
    before = executor.tasks[0]
    executor.need_the_problem("one")
    backend.wait(0.0)
    assert executor.tasks[0].number != before.number


def test_the_rest_of_a_block_goes_to_another_worker() -> None:
    """Ctrl-C also reaches the processes of a pool, which return their finished samples."""
    work, executor = Work.of(posing_bar(), 4), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, 4)
    executor.solve("one", only=[0, 2])
    assert [one.sample for one in backend.wait(0.0)] == [0, 2]
    (rest,) = executor.tasks
    assert rest.samples == (1, 3)
    np.testing.assert_array_equal(rest.inputs, work.inputs[[1, 3]])
    np.testing.assert_array_equal(rest.starts, work.starts[[1, 3]])


def test_finished_samples_survive_cancel() -> None:
    work, executor = Work.of(posing_bar(), 4), ScriptedExecutor()
    backend = backend_of(executor, work.problem)
    work.submit(backend, 1)
    futures = [future for _, future in executor.waiting]
    executor.solve("one")
    executor.fail(RuntimeError("ignored"))
    backend.cancel()
    assert [future.cancelled() for future in futures] == [False, False, True, True]
    assert list(outcomes(backend.wait(5.0))) == [0]
    assert backend.wait(5.0) == []
    backend.close()
    backend.close()


def test_cancel_ends_the_solves_of_threads_at_once() -> None:
    # minutes of work unless it is cancelled
    work = Work.of(posing_bar(24, 6, 6, bound=0.7), 32)
    options = replace(OPTIONS, solver="newton", tolerance=1e-300, max_iterations=10**6)
    with ThreadPoolExecutor(2) as pool:
        backend = backend_of(pool, work.problem, options)
        work.submit(backend, 2)
        before = len(backend.wait(0.3))
        begin = time.perf_counter()
        backend.cancel()
        assert time.perf_counter() - begin < 0.1
    assert time.perf_counter() - begin < 1.0
    solved = backend.wait(1.0)
    assert before + len(solved) < 16
    assert all(one.report.status != "cancelled" for one in solved)


def test_a_problem_lives_no_longer_than_its_run() -> None:
    work = Work.of(posing_bar(), 2)
    with ThreadPoolExecutor(1) as pool:
        backend = backend_of(pool, work.problem)
        work.submit(backend, 2)
        collected(backend, 2)
        problem = weakref.ref(work.problem)
        del work, backend
        # a worker thread drops its last task when it takes the next one
        pool.submit(int).result()
        gc.collect()
        assert problem() is None


def test_a_worker_holds_only_a_few_problems() -> None:
    held = HeldProblems()
    payloads = {str(k): pickle.dumps((posing_bar(stiffness=k), None)) for k in (1.0, 2.0, 3.0)}

    def received(key: str, payload: bytes | None = None) -> HeldProblem | None:
        return held.received(key, payload, OPTIONS)

    assert received("1.0") is None
    first = received("1.0", payloads["1.0"])
    received("2.0", payloads["2.0"])
    assert received("1.0") is first, "used last, so not unpickled again"
    received("3.0", payloads["3.0"])
    assert received("2.0") is None
    assert received("1.0") is first


@pytest.mark.parametrize("soft_modes", [True, False])
def test_a_worker_computes_soft_modes_only_on_request(soft_modes: bool) -> None:
    """They take as long as a few samples."""
    held = HeldProblems().received(
        "key", pickle.dumps((posing_bar(), None)), replace(OPTIONS, soft_modes=soft_modes)
    )
    assert held is not None
    assert ("_soft_modes" in vars(held.problem)) == soft_modes
