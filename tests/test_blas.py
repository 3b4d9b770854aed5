"""The limit of one BLAS thread holds as long as any function that asked for it runs."""

from __future__ import annotations

from collections.abc import Iterator
from threading import Event, Thread

import pytest
from threadpoolctl import threadpool_info

from snapspace.blas import single_threaded_blas

SECONDS = 10.0  # a thread that waits longer has failed


def limits() -> list[int]:
    return [int(pool["num_threads"]) for pool in threadpool_info() if pool["user_api"] == "blas"]


@pytest.fixture(autouse=True)
def several_threads() -> Iterator[None]:
    """BLAS has several threads before, and as many afterwards."""
    before = limits()
    if min(before) == 1:
        pytest.skip("BLAS has one thread here anyway")
    yield
    assert limits() == before


@single_threaded_blas
def limits_inside() -> list[int]:
    return limits()


class Call:
    """A call on its own thread. It ends when it may leave, and records its limits just before."""

    def __init__(self) -> None:
        self.limits: list[int] = []
        self._inside, self._end = Event(), Event()
        self._thread = Thread(target=self._run)

    def enter(self) -> None:
        self._thread.start()
        assert self._inside.wait(SECONDS)

    def leave(self) -> None:
        self._end.set()
        if self._thread.ident is None:  # never entered
            return
        self._thread.join(SECONDS)
        assert not self._thread.is_alive()

    @single_threaded_blas
    def _run(self) -> None:
        self._inside.set()
        self._end.wait(SECONDS)
        self.limits = limits()  # read last: other calls may have left by now


@pytest.fixture
def calls() -> Iterator[list[Call]]:
    """Two calls, which leave when the test ends at the latest."""
    both = [Call(), Call()]
    yield both
    for call in both:
        call.leave()


@pytest.mark.parametrize("first_to_leave", [0, 1])
@pytest.mark.parametrize("before", [[], ["a call on this thread"]])
def test_the_limit_holds_until_the_last_of_two_calls_leaves(
    calls: list[Call], first_to_leave: int, before: list[str]
) -> None:
    """If each call restored what it found, the second would leave the limit at one for ever."""
    for _ in before:
        assert set(limits_inside()) == {1}
    for call in calls:
        call.enter()
        assert set(limits()) == {1}
    calls[first_to_leave].leave()
    assert set(limits()) == {1}
    calls[1 - first_to_leave].leave()
    assert all(set(call.limits) == {1} for call in calls)


@pytest.mark.parametrize("first", ["this thread", "the other"])
def test_the_last_to_leave_need_not_be_the_first_to_enter(calls: list[Call], first: str) -> None:
    """Some versions of threadpoolctl let only one thread change the limits."""
    call = calls[0]

    @single_threaded_blas
    def overlapping() -> list[int]:
        (call.enter if first == "this thread" else call.leave)()
        return limits()

    if first == "this thread":
        assert set(overlapping()) == {1}
        assert set(limits()) == {1}
        call.leave()
    else:
        call.enter()
        assert set(overlapping()) == {1}
    assert set(call.limits) == {1}


def test_calls_may_be_nested() -> None:
    @single_threaded_blas
    def outer() -> tuple[list[int], list[int]]:
        return limits_inside(), limits()

    for found in outer():
        assert set(found) == {1}


def test_an_error_lifts_the_limit() -> None:
    @single_threaded_blas
    def fail() -> None:
        raise ArithmeticError("inside")

    with pytest.raises(ArithmeticError, match="inside"):
        fail()


def test_the_function_keeps_its_name_and_docstring() -> None:
    @single_threaded_blas
    def product(a: float, *, b: float = 3.0) -> float:
        """a times b."""
        return a * b

    assert (product(2.0), product(2.0, b=4.0)) == (6.0, 8.0)
    assert (product.__name__, product.__doc__) == ("product", "a times b.")
