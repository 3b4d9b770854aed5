"""Blocks on a dask cluster, which may lose a worker."""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from snapspace import SolveProgress, SolverOptions, sample, solve_snapshots

from ..shapes import interpolation_problem
from .bars import assert_same_bits, parameters, posing_bar
from .blocks import DeadlyProblem, Work, assert_same_outcomes, backend_of, collected, sent_once

distributed = pytest.importorskip("distributed", reason="needs the extra snapspace[dask]")

WORKERS = 2
PATIENCE = 60.0  # seconds


@pytest.fixture
def client(cluster: Any) -> Iterator[Any]:
    """A client of the cluster once all workers are up, also after a test that killed one."""
    with distributed.Client(cluster, set_as_default=False) as client:
        wait_for_processes(client)
        client.run(exec, "import snapspace")  # so that none is idle while another one imports
        yield client


def wait_for_processes(client: Any) -> dict[str, int]:
    """Process ids of all workers, by address, once each of them answers.

    The scheduler counts a killed worker until it notices its loss.
    """
    end = time.monotonic() + PATIENCE
    while True:
        found: dict[str, int] = client.run(os.getpid, on_error="ignore")
        if len(found) == WORKERS:
            return found
        assert time.monotonic() < end, f"only {found} answer"
        time.sleep(0.05)


def test_a_cluster_gives_the_same_bits_and_has_the_problem_sent_once(
    client: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = posing_bar(16, 3, 3, bound=0.7)
    sent_once(client.get_executor(), problem, WORKERS, monkeypatch)


def test_large_meshes_do_not_make_dask_warn(client: Any) -> None:
    """Dask warns about tasks above 10 MB and about sending them twice; warnings are errors."""
    dask = pytest.importorskip("dask")
    work = Work.of(posing_bar(), 4)
    backend = backend_of(client.get_executor(), work.problem)
    with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 kB"}):
        work.submit(backend, 2)
        collected(backend, 4)
    assert backend.payloads_sent


def test_snapshots_of_poses_equal_those_of_this_machine(client: Any) -> None:
    problem, options = interpolation_problem(), SolverOptions(block=4)
    samples = sample(problem.domain, 8, seed=1)
    here = solve_snapshots(problem, samples, options=options, threads=1)
    there = solve_snapshots(problem, samples, options=options, executor=client.get_executor())
    assert_same_bits(there, here)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
def test_nothing_is_lost_with_a_worker(client: Any) -> None:
    """Dask gives the blocks of a killed worker to the other one, which may lack the problem."""
    work = Work.of(posing_bar(24, 4, 4, bound=0.7), 40)
    pids = wait_for_processes(client)
    killed: list[int] = []

    def kill_one(finished: int) -> None:
        if not killed:
            killed.append(pids[min(pids)])
            os.kill(killed[0], signal.SIGKILL)
            assert finished < 20, "too late: hardly any block was left"

    backend = backend_of(client.get_executor(), work.problem)
    work.submit(backend, 2)
    found = collected(backend, 40, after_each=kill_one)
    assert_same_outcomes(found, work.solved_here())
    assert killed[0] not in wait_for_processes(client).values()


def test_a_run_that_loses_a_worker_ends_with_the_same_snapshots(client: Any) -> None:
    problem = posing_bar(24, 4, 4, bound=0.7)
    samples = parameters(problem, 48)
    here = solve_snapshots(problem, samples, threads=1)
    left = list(wait_for_processes(client).values())[:1]

    def kill_one(state: SolveProgress) -> None:
        if left and state.done:
            assert state.done < state.total
            os.kill(left.pop(), signal.SIGKILL)

    executor = client.get_executor()
    there = solve_snapshots(problem, samples, executor=executor, progress=kill_one)
    assert not left
    assert_same_bits(there, here)


def test_a_problem_that_kills_every_worker_is_refused(
    client: Any, cluster: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One lost worker is enough here; by default dask tries three more."""
    monkeypatch.setattr(cluster.scheduler, "allowed_failures", 0)
    deadly: Any = DeadlyProblem()
    backend = backend_of(client.get_executor(), deadly)
    backend.submit([2, 3], np.zeros((2, 6)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match=r"lost the worker that solved samples 2 to 3 \(Killed"):
        backend.wait(PATIENCE)
    backend.close()


def test_a_closed_connection_is_reported(cluster: Any) -> None:
    work = Work.of(posing_bar(24, 4, 4, bound=0.7), 40)
    client = distributed.Client(cluster, set_as_default=False)
    backend = backend_of(client.get_executor(), work.problem)
    work.submit(backend, 8)
    client.close()
    # running blocks are cancelled, and later ones refused
    message = r"executor: (cancelled|does not accept) samples .* in the checkpoint"
    with pytest.raises(ValueError, match=message):
        while backend.wait(PATIENCE):
            pass
    backend.close()


def test_cancelled_blocks_leave_the_cluster_free(client: Any) -> None:
    work = Work.of(posing_bar(24, 4, 4, bound=0.7), 40)
    backend = backend_of(client.get_executor(), work.problem)
    work.submit(backend, 4)
    assert backend.wait(PATIENCE)
    backend.close()
    assert client.submit(int, pure=False).result(timeout=PATIENCE) == 0
