"""An executor whose workers are scripted by the test."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from typing import Any

import numpy as np

from snapspace.snapshots import SampleReport
from snapspace.snapshots.block_task import BlockAnswer, BlockTask
from snapspace.snapshots.solved import Solved

REPORT = SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, 0)


class ScriptedExecutor(Executor):
    """Collects tasks until the test answers them."""

    def __init__(self) -> None:
        self.waiting: list[tuple[BlockTask, Future[BlockAnswer]]] = []

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.waiting.append((args[0], future))
        return future

    @property
    def tasks(self) -> list[BlockTask]:
        """The tasks that no worker has answered yet, in order."""
        return [task for task, _ in self.waiting]

    def need_the_problem(self, worker: str, count: int = 1) -> None:
        """A worker takes the next tasks and does not have the problem."""
        for _ in range(count):
            task, future = self.waiting.pop(0)
            assert task.payload is None
            future.set_result(BlockAnswer(worker, None))

    def solve(self, worker: str, *, only: Sequence[int] | None = None) -> None:
        """A worker solves the next task, or only some of its samples."""
        task, future = self.waiting.pop(0)
        samples = task.samples if only is None else only
        future.set_result(BlockAnswer(worker, [Solved(k, np.zeros(3), REPORT) for k in samples]))

    def fail(self, error: BaseException) -> None:
        """The next task ends with an exception."""
        _, future = self.waiting.pop(0)
        future.set_exception(error)
