"""LocalBackend: solves samples on the threads of this process."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent import futures
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import Problem
from .fast_solve import (
    as_sample_report,
    continue_solving,
    first_iterations,
    needs_another_try,
    seed_of,
)
from .predictions import coarse_space
from .solved import Solved
from .solver_options import ResolvedOptions

FloatArray = NDArray[np.float64]


class LocalBackend:
    """Solves samples as they arrive, on threads that share a queue.

    Parameters
    ----------
    problem : Problem
    options : ResolvedOptions
    expected : int
        Total number of samples that will be submitted.
    threads : int
        Number of threads, 0 for all.
    basis : (3n, d), optional
        Basis of predictions, see `Predictions`.
    """

    def __init__(
        self,
        problem: Problem,
        options: ResolvedOptions,
        *,
        expected: int,
        threads: int,
        basis: FloatArray | None = None,
    ) -> None:
        # made once, before threads need them, and where Ctrl-C can interrupt the work
        _ = problem.system
        self._coarse = coarse_space(problem, basis)
        self._seed = seed_of(problem, options, self._coarse)
        self._problem = problem
        self._options = options
        self._threads = threads
        self._queue = core.SampleQueue()
        self._control = core.SolveControl()
        self._collected: list[core.Solution] = []
        self._inputs: dict[int, FloatArray] = {}
        self._continued: dict[int, Future[Solved]] = {}
        self._pool = ThreadPoolExecutor(max_workers=2)
        self._server = self._pool.submit(self._serve, expected)

    def submit(self, samples: Sequence[int], inputs: FloatArray, starts: FloatArray) -> None:
        """Adds samples: numbers, inputs (k, input_size), starts (k, 3n)."""
        for sample, w, start in zip(samples, inputs, starts, strict=True):
            self._inputs[sample] = w
            self._problem.system.put(self._queue, sample, w, start, coarse=self._coarse)

    def wait(self, timeout: float) -> list[Solved]:
        """Newly finished samples, after at most `timeout` seconds; raises errors of the solvers."""
        if self._server.done():
            self._server.result()
        self._queue.collect(self._collected, timeout)
        collected, self._collected = self._collected, []
        solved = [Solved(one.id, one.shape, as_sample_report(one.report)) for one in collected]
        slow = [one for one in solved if needs_another_try(one.report, self._options)]
        for one in slow:
            self._continued[one.sample] = self._pool.submit(self._continue_solving, one)
        done = [one for one in solved if one.sample not in self._continued]
        for sample in [sample for sample, future in self._continued.items() if future.done()]:
            done.append(self._continued.pop(sample).result())
        for one in done:
            del self._inputs[one.sample]
        return [one for one in done if one.report.status != "cancelled"]

    def running(self) -> dict[int, int]:
        """Samples that are being solved, with their numbers of evaluations."""
        return dict(self._queue.running())

    def no_more(self) -> None:
        """All samples are submitted: packs may get narrower."""
        self._queue.close()

    def cancel(self) -> None:
        """Ends all solves and returns at once; unfinished samples are lost."""
        self._control.cancel()
        self._queue.close()

    def stop(self, seconds: float) -> list[Solved]:
        """Cancels, and returns finished samples once the solvers have stopped or the time is up."""
        self.cancel()
        running: list[Future[Any]] = [self._server, *self._continued.values()]
        futures.wait(running, timeout=seconds)
        return self.wait(0.0)

    def close(self) -> None:
        """Cancels unfinished samples, and waits for the threads."""
        self.cancel()
        self._pool.shutdown()

    def _serve(self, expected: int) -> None:
        options, system = self._options, self._problem.system
        if options.solver == "newton":
            system.serve_newton(
                self._queue,
                expected,
                tolerance=options.tolerance,
                max_iterations=options.max_iterations,
                threads=self._threads,
                projection=core.Projection[options.projection],
                threshold=options.clamp,
                control=self._control,
            )
            return
        system.serve_fast(
            self._queue,
            expected,
            tolerance=options.tolerance,
            max_iterations=first_iterations(self._problem, options),
            threads=self._threads,
            control=self._control,
            single=options.single,
            settling=options.settling,
            **self._seed,
        )

    def _continue_solving(self, slow: Solved) -> Solved:
        shape, report = continue_solving(
            self._problem,
            self._inputs[slow.sample],
            slow.displacement,
            slow.report,
            self._control,
            self._options,
            threads=self._threads,
        )
        return Solved(slow.sample, shape, report)
