"""One computation at a time, and one body for all pages."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from snapspace.generators import bar
from snapspace.server.body import Body
from snapspace.server.computation_queue import ComputationQueue
from snapspace.server.job import Job
from snapspace.server.opening import Opening
from snapspace.server.shared_body import SharedBody
from snapspace.stopping import Stopped, stoppable

PATIENCE = 20.0


def started(work: Callable[[], None], *, failed: Callable[[Exception], None] | None = None) -> Job:
    def no_error(error: Exception) -> None:
        raise error

    return Job(work, failed=failed or no_error)


def test_turns_come_in_order_and_never_two_at_once() -> None:
    queue, order, inside = ComputationQueue(), [], []
    waiting = [threading.Event() for _ in range(4)]
    release = threading.Event()

    def work(number: int) -> Callable[[], None]:
        def run() -> None:
            with queue.turn(lambda before: waiting[number].set()):
                inside.append(number)
                assert len(inside) == 1
                if number == 0:
                    waiting[0].set()
                    assert release.wait(PATIENCE)
                order.append(inside.pop())

        return run

    jobs = []
    for number in range(4):
        jobs.append(started(work(number)))
        assert waiting[number].wait(PATIENCE)
    release.set()
    assert all(job.wait(PATIENCE) for job in jobs)
    assert order == [0, 1, 2, 3]


def test_a_waiting_job_can_be_stopped_and_a_failing_one_lets_the_next_start() -> None:
    queue = ComputationQueue()
    reported: list[int] = []
    entered, release, waits = threading.Event(), threading.Event(), threading.Event()

    def first() -> None:
        with queue.turn(reported.append):
            entered.set()
            assert release.wait(PATIENCE)
            raise ValueError("broken")

    def second() -> None:
        with queue.turn(lambda before: waits.set()):
            raise AssertionError("it was stopped before")

    errors: list[Exception] = []
    one = started(first, failed=errors.append)
    assert entered.wait(PATIENCE)
    two = started(second)
    assert waits.wait(PATIENCE)
    two.stop()
    assert two.wait(PATIENCE)
    release.set()
    assert one.wait(PATIENCE) and str(errors[0]) == "broken"
    with queue.turn(reported.append):
        assert not reported


def test_an_error_after_the_stop_is_not_reported() -> None:
    entered, release = threading.Event(), threading.Event()

    def work() -> None:
        entered.set()
        assert release.wait(PATIENCE)
        raise ValueError("in abandoned work")

    errors: list[Exception] = []
    job = started(work, failed=errors.append)
    assert entered.wait(PATIENCE) and job.running
    job.stop()
    release.set()
    assert job.wait(PATIENCE) and not errors


SILENT = Opening(lambda *_: None)


def test_all_pages_share_a_body_and_the_next_one_makes_it_if_the_first_is_stopped() -> None:
    body = Body(name="bar", mesh=bar(2, 1, 1), file=None, folder=Path())
    makers: list[str] = []
    entered = threading.Event()

    def make(opening: Opening) -> Body:
        makers.append(threading.current_thread().name)
        opening.stage("filling")
        if len(makers) == 1:
            entered.set()
            assert stop.wait(PATIENCE)
            raise Stopped
        return body

    shared, stop, waits = SharedBody(make), threading.Event(), threading.Event()
    first = started(lambda: ignore(shared.get(SILENT)))
    assert entered.wait(PATIENCE)
    reported: list[str] = []

    def record(stage: str) -> None:
        reported.append(stage)
        waits.set()

    second = started(lambda: ignore(shared.get(Opening(record))))
    assert waits.wait(PATIENCE)
    stop.set()
    assert first.wait(PATIENCE) and second.wait(PATIENCE)
    assert reported[0] == "waiting" and reported[-1] == "filling"
    assert shared.get(SILENT) is body and len(makers) == 2


def test_a_job_that_waits_for_a_body_can_be_stopped() -> None:
    shared = SharedBody(lambda _: pytest.fail("the lock is taken"))
    with shared._lock, stoppable(lambda: True), pytest.raises(Stopped):
        shared.get(SILENT)


def ignore(_: object) -> None:
    """Discards a result."""
