"""ExecutorBackend: blocks of samples on any concurrent.futures.Executor."""

from __future__ import annotations

import hashlib
import pickle
import uuid
import warnings
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import replace
from itertools import count
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import Problem
from .block_task import BlockAnswer, BlockTask, solve_block
from .executor_faults import cancelled_fault, refused_fault, task_fault
from .held_problems import HELD_PROBLEMS, HeldProblem, RunContext
from .predictions import coarse_space
from .solved import Solved
from .solver_options import ResolvedOptions
from .worker_names import for_worker

FloatArray = NDArray[np.float64]


class ExecutorBackend:
    """Solves blocks of samples on an executor; each block is one task on one thread.

    The problem is not sent with the tasks. A worker that lacks it answers so, and gets it with the
    next block. Until then, other blocks that this worker returned are held back. Workers in this
    process (a thread pool) share the problem itself.

    Parameters
    ----------
    executor : Executor
        An executor of threads, processes or a cluster. It is not shut down.
    problem : Problem
        A problem that can be pickled. Its mean shape, if not known, is computed here.
    options : ResolvedOptions
        A sample is bitwise the same as in a local run with the same options, in any block.
    basis : (3n, d), optional
        Basis of predictions, see `Predictions`; it is sent with the problem.

    Raises
    ------
    ValueError
        If the problem cannot be pickled.

    Notes
    -----
    For use by one thread. `payloads_sent` counts the problems sent: about one per worker process.
    """

    def __init__(
        self,
        executor: Executor,
        problem: Problem,
        options: ResolvedOptions,
        *,
        basis: FloatArray | None = None,
    ) -> None:
        _ = problem.tau  # found once here, and not by every worker
        self.payloads_sent = 0
        self._executor = executor
        self._options = options
        self._payload = _pickled(problem, basis)
        # not the fingerprint, which does not depend on a given mean shape
        self._key = hashlib.sha256(self._payload).hexdigest()
        self._run = uuid.uuid4().hex
        self._context = RunContext(
            HeldProblem(problem, coarse_space(problem, basis)), core.SolveControl()
        )
        HELD_PROBLEMS.share(self._run, self._context)
        self._numbers = count()
        self._in_flight: dict[Future[BlockAnswer], BlockTask] = {}
        self._carriers: dict[Future[BlockAnswer], str] = {}  # tasks with the problem, by worker
        self._held_back: list[BlockTask] = []
        self._collected: list[Solved] = []
        self._cancelled = False

    def submit(self, samples: Sequence[int], inputs: FloatArray, starts: FloatArray) -> None:
        """Submits a block: k sample numbers, inputs (k, input_size), starts (k, 3n).

        Raises
        ------
        ValueError
            If the executor no longer accepts work.
        """
        task = BlockTask(
            run=self._run,
            problem=self._key,
            number=0,
            samples=tuple(int(sample) for sample in samples),
            inputs=inputs,
            starts=starts,
            options=self._options,
        )
        self._send(task)

    def wait(self, timeout: float) -> list[Solved]:
        """Newly finished samples, in any order.

        Returns as soon as there are any, or no task is in flight, or after `timeout` seconds. After
        `cancel`, returns samples that were finished nevertheless.

        Raises
        ------
        ValueError, MemoryError, RuntimeError
            For a block that failed, with its samples in the message, or for a lost worker. A later
            call still returns other finished samples.
        """
        deadline = monotonic() + timeout
        while not self._collected and self._in_flight:
            left = deadline - monotonic()
            done, _ = wait(self._in_flight, timeout=max(left, 0.0), return_when=FIRST_COMPLETED)
            # results first, since an error would keep them from the caller
            for future in sorted(done, key=_has_failed):
                if self._collected and _has_failed(future):
                    break
                self._collect(future)
            if left <= 0:
                break
        solved, self._collected = self._collected, []
        return solved

    def running(self) -> dict[int, int]:
        """Empty: workers do not report the progress of their samples."""
        return {}

    def no_more(self) -> None:
        """All samples are submitted."""

    def cancel(self) -> None:
        """Makes tasks end soon; returns at once. Other processes finish what they have begun."""
        self._cancelled = True
        self._context.control.cancel()
        self._held_back.clear()
        for future in list(self._in_flight):
            if future.cancel():
                del self._in_flight[future]

    def stop(self, seconds: float) -> list[Solved]:
        """Cancels, and returns finished samples once tasks have ended or the time is up."""
        self.cancel()
        deadline, solved = monotonic() + seconds, []
        while self._in_flight and monotonic() < deadline:
            solved += self.wait(deadline - monotonic())
        return solved + self.wait(0.0)

    def close(self) -> None:
        """Cancels tasks in flight and drops all results; the executor stays open."""
        self.cancel()
        self._in_flight.clear()
        self._carriers.clear()
        self._collected.clear()

    def _send(self, task: BlockTask, *, worker: str | None = None) -> Future[BlockAnswer]:
        """Submits a task, to the worker of this name if the executor can choose."""
        numbered = replace(task, number=next(self._numbers))
        place = {} if worker is None else for_worker(self._executor, worker)
        try:
            with warnings.catch_warnings():
                # dask recommends sending large data once per worker, as is done here
                warnings.filterwarnings("ignore", message="Sending large graph")
                future = self._executor.submit(solve_block, numbered, **place)
        except Exception as error:
            raise refused_fault(error, task.samples) from error
        self._in_flight[future] = task
        return future

    def _collect(self, future: Future[BlockAnswer]) -> None:
        """Collects the answer of a finished future, and sends the rest of its block."""
        task, is_carrier = self._in_flight[future], future in self._carriers
        try:
            answer = self._answer(future, task)
            # before the future is dropped, so that Ctrl-C in between repeats samples and loses none
            self._collected += answer.solved or [] if answer else []
        finally:
            del self._in_flight[future]
            self._carriers.pop(future, None)
        if answer is None or self._cancelled:
            return
        if answer.solved is None:
            self._send_problem(task, answer.worker)
            return
        self._send_rest(task, answer.solved)
        if is_carrier:
            held_back, self._held_back = self._held_back, []
            for held in held_back:
                self._send(held)

    def _answer(self, future: Future[BlockAnswer], task: BlockTask) -> BlockAnswer | None:
        """The answer of a task; None if it failed after `cancel`, when it is not needed."""
        if future.cancelled():
            if self._cancelled:
                return None
            raise cancelled_fault(task.samples)
        error = future.exception()
        if error is None:
            return future.result()
        if self._cancelled:
            return None
        raise task_fault(error, task.samples) from error

    def _send_problem(self, task: BlockTask, worker: str) -> None:
        """Sends a block again, with the problem that its worker lacked."""
        if worker in self._carriers.values():
            self._held_back.append(task)
            return
        carrier = self._send(replace(task, payload=self._payload), worker=worker)
        self._carriers[carrier] = worker
        self.payloads_sent += 1

    def _send_rest(self, task: BlockTask, solved: Sequence[Solved]) -> None:
        """Sends the samples of a block that Ctrl-C in a worker left unfinished."""
        finished = {one.sample for one in solved}
        rest = [k for k, sample in enumerate(task.samples) if sample not in finished]
        if rest:
            samples = tuple(task.samples[k] for k in rest)
            inputs, starts = task.inputs[rest], task.starts[rest]
            self._send(replace(task, samples=samples, inputs=inputs, starts=starts, payload=None))


def _has_failed(future: Future[BlockAnswer]) -> bool:
    return future.cancelled() or future.exception() is not None


def _pickled(problem: Problem, basis: FloatArray | None) -> bytes:
    try:
        # the core stores a basis in single precision
        single = None if basis is None else basis.astype(np.float32)
        return pickle.dumps((problem, single), protocol=pickle.HIGHEST_PROTOCOL)
    except (pickle.PicklingError, TypeError, AttributeError) as error:
        raise ValueError(
            f"executor: the problem cannot be sent to workers ({error}); give its class a "
            "__reduce__ with what defines it, or solve without an executor"
        ) from None
