"""Computation: a sequence of better and better models of a problem, for one page."""

from __future__ import annotations

from collections.abc import Callable

from ..accurate import Growth, check_most, growing_models
from ..arguments import check_target
from ..mesh import EmbeddedSurface
from ..problem import PosingProblem
from ..reduction import PosingModel
from ..snapshots import Interrupted, SolveProgress
from .computation_queue import ComputationQueue
from .messages import Compute
from .reporter import Reporter
from .solved_samples import SolvedSamples

Publish = Callable[[Growth, float], None]

#: More samples would take hours, or more memory than is available.
MOST_SAMPLES = 20_000


class Computation:
    """The work for one `Compute` message.

    Parameters
    ----------
    problem : PosingProblem
    order : Compute
    queue : ComputationQueue
        The queue of the machine.
    solved : SolvedSamples
        Known samples; finished samples are added, even if the computation is stopped.
    report : Reporter
        Sends the progress.
    start : PosingModel or None
        A model with other handles to start from, see `growing_models`.
    surface : EmbeddedSurface or None
        The surface that the models show instead of the tets' surface.
    publish : callable
        Called with each model and the seconds since the computation began.

    Raises
    ------
    ValueError
        For an invalid target, number of samples or seed.
    """

    def __init__(
        self,
        problem: PosingProblem,
        order: Compute,
        *,
        queue: ComputationQueue,
        solved: SolvedSamples,
        report: Reporter,
        start: PosingModel | None,
        surface: EmbeddedSurface | None,
        publish: Publish,
    ) -> None:
        _check(order)
        self._problem, self._order = problem, order
        self._queue, self._solved = queue, solved
        self._report, self._publish = report, publish
        self._start, self._surface = start, surface
        self._error: float | None = None  # error of the newest model

    def run(self) -> None:
        """Computes all models; raises the ValueErrors of the computation."""
        order = self._order
        with self._queue.turn(self._report_waiting):
            self._report.restart()
            self._report.send("snapshots")
            try:
                for growth in growing_models(
                    self._problem,
                    target_error=order.target_error,
                    most_samples=order.most_samples,
                    seed=order.seed,
                    progress=self._report_solving,
                    known=self._solved.starts(self._problem),
                    begins=self._report_stage,
                    start=self._start,
                    surface=self._surface,
                ):
                    self._take(growth)
                    self._publish(growth, self._report.seconds)
            except Interrupted as stop:
                if stop.finished is not None:
                    self._solved.add(stop.finished)
                raise

    def _take(self, growth: Growth) -> None:
        if growth.final:
            self._solved.replace(growth.snapshots)
        else:
            self._solved.add(growth.snapshots)
        if growth.step is not None:
            self._error = growth.step.error

    def _report_waiting(self, before: int) -> None:
        self._report.send("waiting", 0, before)

    def _report_stage(self, stage: str) -> None:
        if stage != "snapshots":
            self._report.send(stage, error=self._error)

    def _report_solving(self, progress: SolveProgress) -> None:
        done, total, eta = progress.done, progress.total, progress.eta
        self._report.send("snapshots", done, total, eta=eta, error=self._error)


def _check(order: Compute) -> None:
    check_target(order.target_error)
    if order.most_samples is not None:
        check_most(order.most_samples)
        if order.most_samples > MOST_SAMPLES:
            raise ValueError(
                f"most_samples is {order.most_samples}, but the page takes at most {MOST_SAMPLES}"
            )
    if order.seed < 0:
        raise ValueError(f"seed is {order.seed}, but it must not be negative")
