"""A backend that returns samples one at a time, when the test says so."""

from __future__ import annotations

import random
import weakref
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import _core as core
from snapspace.problem import Problem
from snapspace.snapshots import run
from snapspace.snapshots.fast_solve import as_sample_report, solve_fast
from snapspace.snapshots.solved import Solved
from snapspace.snapshots.solver_options import ResolvedOptions

FloatArray = NDArray[np.float64]


def proceed(_: int) -> None:
    """Lets the run continue."""


@dataclass
class Script:
    """The script of a run.

    seed : seed of the order in which running samples finish
    before_wait : called with the number of samples returned so far; may raise
    given : the samples that were returned, in order
    arrays : weak references to their displacements
    """

    seed: int = 0
    before_wait: Callable[[int], None] = proceed
    given: list[int] = field(default_factory=list)
    arrays: list[weakref.ref[FloatArray]] = field(default_factory=list)

    @contextmanager
    def plays(self) -> Iterator[None]:
        """Inside, a `ScriptedBackend` solves runs that have no executor."""

        def backend(
            problem: Problem,
            options: ResolvedOptions,
            *,
            expected: int,
            threads: int,
            basis: FloatArray | None,
        ) -> ScriptedBackend:
            return ScriptedBackend(problem, options, self)

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(run, "LocalBackend", backend)
            yield


class ScriptedBackend:
    """Solves samples when they are submitted, and returns one at each `wait`."""

    def __init__(self, problem: Problem, options: ResolvedOptions, script: Script) -> None:
        self._problem = problem
        self._options = options
        self._script = script
        self._order = random.Random(script.seed)
        self._under_way: list[Solved] = []

    def submit(self, samples: Sequence[int], inputs: FloatArray, starts: FloatArray) -> None:
        options, control = self._options, core.SolveControl()
        if options.solver == "fast":
            shapes, reports = solve_fast(self._problem, inputs, starts, control, options, threads=1)
        else:
            batch = self._problem.system.solve_newton(
                inputs,
                starts,
                tolerance=options.tolerance,
                max_iterations=options.max_iterations,
                projection=core.Projection[options.projection],
                threshold=options.clamp,
                threads=1,
                control=control,
            )
            shapes, reports = batch.shapes, [as_sample_report(one) for one in batch.reports]
        for sample, shape, report in zip(samples, shapes, reports, strict=True):
            self._under_way.append(Solved(sample, shape.copy(), report))

    def running(self) -> dict[int, int]:
        """The running samples with all evaluations except one: they count as nearly done."""
        return {one.sample: one.report.evaluations - 1 for one in self._under_way}

    def no_more(self) -> None:
        pass

    def wait(self, timeout: float) -> list[Solved]:
        if not self._under_way:
            return []
        self._script.before_wait(len(self._script.given))
        one = self._under_way.pop(self._order.randrange(len(self._under_way)))
        self._script.given.append(one.sample)
        self._script.arrays.append(weakref.ref(one.displacement))
        return [one]

    def cancel(self) -> None:
        self._under_way.clear()

    def stop(self, seconds: float) -> list[Solved]:
        self.cancel()
        return []

    def close(self) -> None:
        self.cancel()
