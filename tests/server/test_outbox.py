"""Messages wait for a slow page; only outdated progress is dropped."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor

from snapspace.server.messages import Cancelled, Progress
from snapspace.server.outbox import Item, Outbox


def progress(stage: str, done: int, *, request: int = 1) -> Progress:
    return Progress(
        request=request, stage=stage, done=done, total=10, seconds=0.0, eta=None, error=None
    )


def received(*puts: tuple[Item, ...]) -> list[Item]:
    """The items that a page receives if it was away while they were put."""

    async def all_of_them() -> list[Item]:
        outbox = Outbox(asyncio.get_running_loop())
        for items in puts:
            outbox.put(*items)
        outbox.put(b"end")
        items = [await outbox.get()]
        while items[-1] != b"end":
            items.append(await outbox.get())
        return items[:-1]

    with ThreadPoolExecutor(1) as pool:  # this thread may still have another test's loop
        return pool.submit(asyncio.run, all_of_them()).result()


def test_the_newest_progress_of_a_stage_is_enough() -> None:
    assert received(*((progress("snapshots", k),) for k in range(5))) == [progress("snapshots", 4)]


def test_no_stage_is_lost() -> None:
    """A page that was away for a moment still sees that the subspace was computed."""
    stages = [progress(stage, 0) for stage in ("snapshots", "subspace", "energy")]
    assert received(*((stage,) for stage in stages)) == stages


def test_requests_are_kept_apart() -> None:
    both = [progress("snapshots", 9, request=1), progress("snapshots", 1, request=2)]
    assert received(*((one,) for one in both)) == both


def test_answers_stay_together_and_in_order() -> None:
    answer = Cancelled(request=2)
    before, after = progress("snapshots", 1), progress("snapshots", 2)
    assert received((before,), (answer, b"frame"), (after,)) == [before, answer, b"frame", after]
