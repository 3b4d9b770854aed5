"""Solving: how samples are solved, and who is told."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass, replace

from ..problem import InterpolationProblem, PosingProblem
from ..reduction import training_tolerance
from ..snapshots import Checkpoint, Progress, SolveProgress, SolverOptions
from .plan import is_large, plan_of

#: Tolerance of held-out samples, relative to the usual one of the others.
JUDGING = 0.01


@dataclass(frozen=True, kw_only=True)
class Solving:
    """Arguments as for `solve_snapshots`, for samples of all stages.

    progress : counts all samples of a stage, those of earlier ones among them
    """

    options: SolverOptions | None = None
    threads: int | None = None
    progress: Progress | None = None
    checkpoint: Checkpoint | None = None
    executor: Executor | None = None

    def usual(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Of samples that train."""
        if self.options is not None:
            return self.options
        tight = self._tight(problem)
        if tight is None or not is_large(problem):
            return SolverOptions(tolerance=tight)
        return SolverOptions(tolerance=tight * plan_of(problem).looser_if_large)

    def judging(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Of samples that judge.

        They are solved more tightly: along soft modes the others are off by as much as a model.
        """
        usual = self.options or SolverOptions(tolerance=self._tight(problem))
        return replace(
            usual,
            tolerance=JUDGING * usual.resolved(problem).tolerance,
            settling=None,
            precision=None,
            max_iterations=5000,
        )

    @staticmethod
    def _tight(problem: PosingProblem | InterpolationProblem) -> float | None:
        return training_tolerance(problem, plan_of(problem).most_dimensions)

    def loose(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Of samples for a first impression.

        By the energy: they are far from settling, and what counts is how far.
        """
        usual = self.usual(problem)
        tolerance = max(usual.tolerance or 0.0, problem.solving.loose_tolerance)
        return replace(usual, tolerance=tolerance, settling=None, soft_modes=False)

    def counting(self, before: int, total: int) -> Progress | None:
        """Tells of samples that come after others of a stage."""
        tell = self.progress
        if tell is None:
            return None

        def counted(state: SolveProgress) -> None:
            tell(replace(state, done=before + state.done, total=total))

        return counted
