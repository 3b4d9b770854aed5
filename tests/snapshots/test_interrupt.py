"""Ctrl-C keeps finished samples, wherever it arrives, and the same call resumes from there."""

from __future__ import annotations

import _thread
import json
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from snapspace import (
    Checkpoint,
    Interrupted,
    SolveProgress,
    SolverOptions,
    interruptible,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.interruptible import run_abandonable, run_interruptible
from snapspace.snapshots import SOLVERS, local_backend, run
from snapspace.snapshots.solver_options import Solver

from .bars import assert_same_bits, parameters, posing_bar

PATIENCE = 20.0  # seconds that a test waits for a thread before it fails


class FakeControl:
    """A SolveControl that reports its cancellation."""

    def __init__(self) -> None:
        self.cancelled = threading.Event()
        self.finished = 0

    def cancel(self) -> None:
        self.cancelled.set()


@pytest.fixture(autouse=True)
def quick_polls(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interruptible, "POLL_SECONDS", 0.002)


@pytest.fixture
def fake_control(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(interruptible, "core", SimpleNamespace(SolveControl=FakeControl))
    yield


def until_cancelled(control: Any) -> str:
    """A solve that finishes three samples and then waits to be cancelled."""
    control.finished = 3
    assert control.cancelled.wait(PATIENCE), "nobody cancelled the solve"
    return "partial result"


@pytest.mark.usefixtures("fake_control")
def test_an_undisturbed_solve_returns_its_result() -> None:
    seen: list[int] = []

    def solve(control: Any) -> str:
        control.finished = 1
        time.sleep(0.02)
        control.finished = 2
        return "result"

    assert run_interruptible(solve, seen.append) == ("result", False)
    assert seen == sorted(seen) and seen[-1] == 2


@pytest.mark.usefixtures("fake_control")
def test_a_failing_progress_display_ends_the_solve_at_once() -> None:
    def broken(finished: int) -> None:
        raise BrokenPipeError("nobody reads")

    with pytest.raises(BrokenPipeError, match="nobody reads"):
        run_interruptible(until_cancelled, broken)


@pytest.mark.usefixtures("fake_control")
def test_ctrl_c_cancels_the_solve_and_keeps_its_result() -> None:
    seen: list[int] = []
    timer = threading.Timer(0.05, _thread.interrupt_main)

    def solve(control: Any) -> str:
        timer.start()
        return until_cancelled(control)

    assert run_interruptible(solve, seen.append) == ("partial result", True)
    assert 3 in seen


@pytest.mark.usefixtures("fake_control")
def test_ctrl_c_while_progress_is_drawn_keeps_the_result() -> None:
    def progress(finished: int) -> None:
        if finished == 3:
            raise KeyboardInterrupt

    assert run_interruptible(until_cancelled, progress) == ("partial result", True)


@pytest.mark.usefixtures("fake_control")
def test_ctrl_c_at_the_very_end_is_not_lost() -> None:
    def solve(control: Any) -> str:
        control.finished = 5
        return "result"

    def progress(finished: int) -> None:
        if finished == 5:
            raise KeyboardInterrupt

    assert run_interruptible(solve, progress) == ("result", True)


@pytest.mark.usefixtures("fake_control")
def test_an_error_of_the_solve_reaches_the_caller() -> None:
    def solve(control: Any) -> str:
        raise ValueError("the factor is not positive definite")

    with pytest.raises(ValueError, match="not positive definite"):
        run_interruptible(solve, lambda finished: None)


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_interrupted_run_resumes_to_the_same_result(tmp_path: Path, solver: Solver) -> None:
    problem = posing_bar()
    samples = parameters(problem, 32)
    options = SolverOptions(solver=solver, block=4)
    checkpoint = Checkpoint(tmp_path / "run")
    seen = 0

    def progress(state: SolveProgress) -> None:
        nonlocal seen
        seen = state.done
        if seen > 4:  # at most 24 are submitted by then
            raise KeyboardInterrupt

    with pytest.raises(Interrupted, match=r"of 32 samples are finished") as caught:
        solve_snapshots(
            problem, samples, options=options, threads=1, progress=progress, checkpoint=checkpoint
        )
    saved = checkpoint.load()
    assert seen <= len(saved) < 32
    assert str(caught.value) == f"{len(saved)} of 32 samples are finished"

    first_call: list[int] = []
    resumed = solve_snapshots(
        problem,
        samples,
        options=options,
        threads=2,
        progress=lambda state: first_call.append(state.done),
        checkpoint=checkpoint,
    )
    assert first_call[0] == len(saved), "progress counts the samples that were kept"
    assert_same_bits(resumed, solve_snapshots(problem, samples, options=options, threads=1))


def test_a_solve_of_the_core_ends_soon_after_ctrl_c(tmp_path: Path) -> None:
    """The block would take many seconds; a signal interrupts it after 0.05 s."""
    problem = posing_bar(16, 4, 4, bound=1.0)
    options = SolverOptions(tolerance=1e-14, block=1000)
    checkpoint = Checkpoint(tmp_path / "run")
    timer = threading.Timer(0.05, _thread.interrupt_main)

    def progress(state: SolveProgress) -> None:
        if not timer.is_alive():
            timer.start()

    begin = time.monotonic()
    with pytest.raises(Interrupted):
        solve_snapshots(
            problem,
            parameters(problem, 1000),
            options=options,
            threads=1,
            progress=progress,
            checkpoint=checkpoint,
        )
    assert time.monotonic() - begin < 5.0
    assert len(checkpoint.load()) < 1000


def test_a_sample_that_finishes_during_ctrl_c_is_not_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The signal waits for the call that returns the sample, and is raised after it."""
    controls: list[core.SolveControl] = []

    def control() -> core.SolveControl:
        controls.append(core.SolveControl())
        return controls[-1]

    stand_in = SimpleNamespace(**{**vars(core.core), "SolveControl": control})
    monkeypatch.setattr(local_backend, "core", stand_in)
    monkeypatch.setattr(run, "POLL_SECONDS", PATIENCE)
    problem, checkpoint = posing_bar(16, 5, 5, bound=0.7), Checkpoint(tmp_path / "run")
    _ = problem.system
    timer = threading.Timer(0.01, _thread.interrupt_main)

    def progress(state: SolveProgress) -> None:
        if not state.done:
            timer.start()

    with pytest.raises(Interrupted):
        solve_snapshots(
            problem,
            parameters(problem, 4),
            options=SolverOptions(solver="newton", block=1),  # one at a time
            threads=1,
            progress=progress,
            checkpoint=checkpoint,
        )
    assert len(checkpoint.numbers()) == controls[0].finished


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_cancelled_solve_never_counts_as_finished(solver: Solver) -> None:
    """At any time, the sample is either reported as cancelled or has its usual solution."""
    problem = posing_bar(12, 4, 4, bound=1.0)
    w = parameters(problem, 1)[0]
    inputs = problem.inputs(w[None])
    starts = np.zeros((1, problem.mesh.vertices.size))
    options: dict[str, Any] = {"tolerance": 1e-10, "max_iterations": 1000, "threads": 1}
    if solver == "newton":
        options |= {"projection": core.Projection.stretches, "threshold": 0.6}
    solve = getattr(problem.system, f"solve_{solver}")
    begin = time.monotonic()
    end = solve(inputs, starts, control=core.SolveControl(), **options)
    duration = time.monotonic() - begin
    assert end.reports[0].status.name == "converged"
    statuses = []
    for delay in np.linspace(0.0, duration, 40):
        control = core.SolveControl()
        timer = threading.Timer(delay, control.cancel)
        timer.start()
        batch = solve(inputs, starts, control=control, **options)
        timer.join()
        statuses.append(batch.reports[0].status.name)
        if statuses[-1] != "cancelled":
            assert batch.reports[0].iterations == end.reports[0].iterations
            np.testing.assert_array_equal(batch.shapes, end.shapes)
    assert "cancelled" in statuses


def test_without_a_checkpoint_an_interrupt_is_a_keyboard_interrupt() -> None:
    """Callers that do not handle Interrupted still stop."""
    problem = posing_bar()

    def progress(state: SolveProgress) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        solve_snapshots(problem, parameters(problem, 2), progress=progress)


def test_ctrl_c_is_answered_wherever_it_arrives() -> None:
    """Even inside a standard lock it is answered, and no thread is left that would block exit."""
    command = [sys.executable, "-m", "tests.snapshots.ctrl_c_anywhere"]
    result = subprocess.run(
        command, capture_output=True, text=True, timeout=9 * PATIENCE, cwd=Path(__file__).parents[2]
    )
    assert result.returncode == 0, result.stderr
    found = json.loads(result.stdout)
    assert found["threads"] == [], list(found["outcomes"].items())[-1]
    assert found["handler"] and found["blas"]
    reached = {place: end for place, end in found["outcomes"].items() if end is not None}
    assert len(reached) > 60
    assert set(reached.values()) == {"Interrupted"}


def test_ctrl_c_does_not_wait_for_work_that_cannot_be_stopped() -> None:
    """A factorisation is such work; its thread is abandoned."""
    release, begin = threading.Event(), time.monotonic()
    timer = threading.Timer(0.05, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        run_abandonable(lambda: release.wait(PATIENCE))
    assert time.monotonic() - begin < 0.5
    release.set()


def test_abandonable_work_gives_its_result_or_its_error() -> None:
    assert run_abandonable(lambda: 6 * 7) == 42
    with pytest.raises(ZeroDivisionError):
        run_abandonable(lambda: 1 // 0)
