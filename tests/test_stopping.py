"""Work on another thread ends as at Ctrl-C when it is asked to stop."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from snapspace import Interrupted, SolverOptions, growing_models, solve_snapshots
from snapspace.filling import ftetwild
from snapspace.interruptible import run_abandonable
from snapspace.stopping import Stopped, check_stop, stoppable

from .snapshots.bars import parameters, posing_bar

PATIENCE = 20.0


def stopped_after(seconds: float, work: Callable[[], object]) -> tuple[BaseException | None, float]:
    """What work raises on a thread that is asked to stop, and how many seconds after that."""
    stop, raised = threading.Event(), []
    ended = [0.0]

    def run() -> None:
        try:
            with stoppable(stop.is_set):
                work()
        except BaseException as error:
            raised.append(error)
        ended[0] = time.perf_counter()

    thread = threading.Thread(target=run)
    thread.start()
    time.sleep(seconds)
    asked = time.perf_counter()
    stop.set()
    thread.join(PATIENCE)
    assert not thread.is_alive()
    return (raised[0] if raised else None), ended[0] - asked


def test_compiled_work_that_cannot_be_stopped_is_abandoned() -> None:
    release = threading.Event()
    error, seconds = stopped_after(0.05, lambda: run_abandonable(lambda: release.wait(PATIENCE)))
    release.set()
    assert isinstance(error, Stopped) and isinstance(error, KeyboardInterrupt)
    assert seconds < 5.0


def test_a_run_of_samples_gives_what_is_finished() -> None:
    """An endless run: its tolerance cannot be met, and its last sample never ends."""
    problem = posing_bar(8, 2, 2)
    wanted = parameters(problem, 400)
    options = SolverOptions(tolerance=1e-14, max_iterations=100_000)
    finished = threading.Event()

    def work() -> None:
        solve_snapshots(
            problem,
            np.tile(wanted, (40, 1)),
            options=options,
            threads=1,
            progress=lambda p: finished.set() if p.done else None,
        )

    stop = threading.Event()
    caught: list[Interrupted] = []

    def run() -> None:
        try:
            with stoppable(stop.is_set):
                work()
        except Interrupted as error:
            caught.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    assert finished.wait(PATIENCE)
    stop.set()
    thread.join(PATIENCE)
    (error,) = caught
    assert error.finished is not None and 0 < len(error.finished) < 16_000
    known = {tuple(w) for w in wanted}
    assert all(tuple(w) in known for w in error.finished.parameters)
    for index in range(min(3, len(error.finished))):
        x = error.finished.displacements[index] + problem.base
        value, _ = problem.value_and_gradient(x, error.finished.parameters[index])
        assert value == pytest.approx(error.finished.reports[index].value, rel=1e-6)


def test_growth_reports_its_parts_in_order() -> None:
    problem = posing_bar(6, 2, 2)
    begun: list[str] = []
    stages = list(growing_models(problem, target_error=0.5, most_samples=24, begins=begun.append))
    assert begun == ["snapshots", "subspace", "energy"] * 2
    assert [growth.final for growth in stages] == [False, True]


def test_a_filling_process_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "sleep.py"
    mark = tmp_path / "began"
    program.write_text(f"import time\nopen({str(mark)!r}, 'w').close()\ntime.sleep(600)\n")
    monkeypatch.setattr(ftetwild, "_PROGRAM", program)
    shape = np.zeros((3, 3)), np.zeros((1, 3), np.int32)
    error, seconds = stopped_after(
        0.3, lambda: ftetwild.ftetwild(*shape, edge_length=0.1, tolerance=0.1)
    )
    assert isinstance(error, Stopped) and seconds < 5.0


def test_the_block_ends_with_its_thread_and_nothing_else_is_stopped() -> None:
    with stoppable(lambda: True):
        with pytest.raises(Stopped):
            check_stop()
        other = threading.Thread(target=check_stop)
        other.start()
        other.join()
    check_stop()
