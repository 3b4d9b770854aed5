"""Ctrl-C is raised where work checks for it, once, and as KeyboardInterrupt."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator

import numpy as np
import pytest

from snapspace import stopping
from snapspace.blas import single_threaded_blas
from snapspace.stopping import Termination, check_stop, ctrl_c_as_itself, ctrl_c_at_checks


@pytest.fixture(autouse=True)
def pythons_own_handler() -> Iterator[None]:
    """The test runner may have been started where Ctrl-C is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    signal.signal(signal.SIGINT, before)


def press() -> None:
    signal.raise_signal(signal.SIGINT)


def test_the_next_check_raises_and_no_later_one() -> None:
    with ctrl_c_at_checks():
        check_stop()
        press()
        with pytest.raises(KeyboardInterrupt):
            check_stop()
        check_stop()


def test_the_end_of_the_block_is_a_check() -> None:
    reached = False
    with pytest.raises(KeyboardInterrupt), ctrl_c_at_checks():
        press()
        reached = True
    assert reached


def test_inner_blocks_leave_it_to_the_outer_one() -> None:
    reached = False
    with pytest.raises(KeyboardInterrupt), ctrl_c_at_checks():
        with ctrl_c_at_checks():
            press()
        reached = True
    assert reached


def test_pressing_again_at_once_counts_as_one() -> None:
    with ctrl_c_at_checks():
        press()
        press()
        with pytest.raises(KeyboardInterrupt):
            check_stop()
        press()
        check_stop()


def test_pressing_again_later_ends_work_that_does_not_check(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now = 100.0
    monkeypatch.setattr(stopping, "monotonic", lambda: now)
    with ctrl_c_at_checks():
        press()
        now += stopping.SAME_SECONDS
        press()
        now += 0.1
        with pytest.raises(KeyboardInterrupt):
            press()
        with pytest.raises(KeyboardInterrupt):
            check_stop()


def test_an_error_of_the_block_comes_first() -> None:
    with pytest.raises(ValueError, match="no such file"), ctrl_c_at_checks():
        press()
        raise ValueError("no such file")


def test_another_programs_handler_stays() -> None:
    pressed: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: pressed.append(number))
    try:
        with ctrl_c_at_checks():
            press()
            check_stop()
    finally:
        signal.signal(signal.SIGINT, before)
    assert pressed == [signal.SIGINT]


def test_other_threads_leave_the_main_one_alone() -> None:
    entered, leave = threading.Event(), threading.Event()

    def work() -> None:
        with ctrl_c_at_checks():
            entered.set()
            leave.wait(20.0)

    thread = threading.Thread(target=work)
    thread.start()
    assert entered.wait(20.0)
    try:
        with pytest.raises(KeyboardInterrupt):
            press()
    finally:
        leave.set()
        thread.join()


def test_the_limit_of_blas_is_lifted_before_it_is_raised() -> None:
    @single_threaded_blas
    def pressing() -> None:
        press()
        reached.append(True)

    reached: list[bool] = []
    with pytest.raises(KeyboardInterrupt):
        pressing()
    assert reached


def test_an_error_that_a_library_makes_of_ctrl_c_is_ctrl_c_again() -> None:
    """The library makes it on purpose, or fails while the interrupt passes through it."""
    with pytest.raises(KeyboardInterrupt) as caught, ctrl_c_as_itself():
        try:
            press()
        except KeyboardInterrupt as error:
            raise TypeError("cannot compare") from error
    assert isinstance(caught.value.__cause__, TypeError)

    with pytest.raises(KeyboardInterrupt), ctrl_c_as_itself():
        try:
            press()
        finally:
            threading.Lock().release()  # RuntimeError: release unlocked lock


def test_other_errors_stay_what_they_are() -> None:
    with pytest.raises(ZeroDivisionError), ctrl_c_as_itself():
        try:
            np.zeros(3).reshape(2, 2)
        except ValueError:
            _ = 1 // 0


@pytest.fixture
def termination() -> Iterator[Termination]:
    handler = Termination()
    before = signal.signal(signal.SIGTERM, handler)
    yield handler
    assert signal.getsignal(signal.SIGTERM) is handler
    signal.signal(signal.SIGTERM, before)


def test_termination_is_raised_at_checks_as_well(termination: Termination) -> None:
    reached = False
    with pytest.raises(KeyboardInterrupt), ctrl_c_at_checks():
        signal.raise_signal(signal.SIGTERM)
        reached = True
        check_stop()
    assert reached and termination.came


def test_termination_arrives_where_ctrl_c_is_ignored(termination: Termination) -> None:
    """A script starts its background programs like this."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    reached = False
    try:
        with pytest.raises(KeyboardInterrupt), ctrl_c_at_checks():
            signal.raise_signal(signal.SIGINT)
            check_stop()
            signal.raise_signal(signal.SIGTERM)
            reached = True
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    assert reached and termination.came


def test_ctrl_c_is_not_a_termination(termination: Termination) -> None:
    with pytest.raises(KeyboardInterrupt), ctrl_c_at_checks():
        press()
    assert not termination.came
