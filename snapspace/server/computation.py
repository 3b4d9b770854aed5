"""Computation: models of a problem, better and better, for one page."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..growing import Growth, growing_models
from ..mesh import EmbeddedSurface
from ..problem import PosingProblem
from ..sampling import sample
from ..snapshots import Interrupted, SolveProgress
from .messages import Compute
from .reporter import Reporter
from .solved_samples import SolvedSamples
from .turns import Turns

Publish = Callable[[Growth, float | None, float], None]

#: Beyond them a computation would take hours, or more memory than there is.
MOST_SAMPLES, MOST_DIMENSIONS = 20_000, 100


class Computation:
    """One answer to `Compute`.

    Parameters
    ----------
    problem : PosingProblem
    order : Compute
    turns : Turns
        Of the machine.
    solved : SolvedSamples
        What is known, and where finished samples are kept, also when this is stopped.
    report : Reporter
    surface : EmbeddedSurface or None
        That the models show, in place of the tets'.
    publish : callable
        Gets each model, the expected error of unseen samples or None, and the seconds.

    Raises
    ------
    ValueError
        For numbers of samples, dimensions or a seed that cannot be computed with.
    """

    def __init__(
        self,
        problem: PosingProblem,
        order: Compute,
        *,
        turns: Turns,
        solved: SolvedSamples,
        report: Reporter,
        surface: EmbeddedSurface | None,
        publish: Publish,
    ) -> None:
        _check(order)
        self._problem, self._order = problem, order
        self._turns, self._solved = turns, solved
        self._report, self._surface, self._publish = report, surface, publish
        self._before = 0  # samples of earlier stages, which the present one does not solve
        self._error: float | None = None

    def run(self) -> None:
        """Computes to the last model; ValueError of the numerics."""
        with self._turns.turn(self._waiting):
            self._report.restart()
            self._report.tell("snapshots", 0, self._order.samples)
            try:
                for growth in self._models():
                    self._take(growth)
                    self._publish(growth, self._error, self._report.seconds)
            except Interrupted as stop:
                if stop.finished is not None:
                    self._solved.add(stop.finished)
                raise

    def _models(self) -> Iterator[Growth]:
        order = self._order
        parameters = sample(self._problem.domain, order.samples, method="sobol", seed=order.seed)
        return growing_models(
            self._problem,
            parameters,
            dimension=order.dimension,
            progress=self._solving,
            known=self._solved.starts(self._problem),
            begins=self._begins,
            surface=self._surface,
        )

    def _take(self, growth: Growth) -> None:
        if growth.final:
            self._solved.replace(growth.snapshots)
        else:
            self._solved.add(growth.snapshots)
        self._before = 0 if growth.loose else len(growth.snapshots)

    def _waiting(self, before: int) -> None:
        self._report.tell("waiting", 0, before)

    def _begins(self, part: str) -> None:
        if part != "snapshots":
            self._report.tell(part, error=self._error)

    def _solving(self, progress: SolveProgress) -> None:
        if progress.held_out_error is not None:
            self._error = progress.held_out_error
        done, total = self._before + progress.done, self._before + progress.total
        self._report.tell("snapshots", done, total, eta=progress.eta, error=self._error)


def _check(order: Compute) -> None:
    if not 1 <= order.samples <= MOST_SAMPLES:
        raise ValueError(f"samples is {order.samples}, but it must be from 1 to {MOST_SAMPLES}")
    if not 1 <= order.dimension <= MOST_DIMENSIONS:
        raise ValueError(
            f"dimension is {order.dimension}, but the page solves 1 to {MOST_DIMENSIONS}"
        )
    if order.dimension > order.samples:
        raise ValueError(
            f"dimension {order.dimension} needs at least as many samples, but there are "
            f"{order.samples}; raise the samples or lower the dimension"
        )
    if order.seed < 0:
        raise ValueError(f"seed is {order.seed}, but it must not be negative")
