"""Solving: how samples are solved, and who is told."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass, replace

from ..problem import InterpolationProblem, PosingProblem
from ..snapshots import Checkpoint, Progress, SolveProgress, SolverOptions

#: Tolerance of held-out samples, relative to that of the others.
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

    @property
    def usual(self) -> SolverOptions:
        """Of samples that train."""
        return self.options or SolverOptions()

    def judging(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Of samples that judge.

        They are solved more tightly: along soft modes the others are off by as much as a model.
        """
        tolerance = self.usual.resolved(problem).tolerance
        return replace(
            self.usual,
            tolerance=JUDGING * tolerance,
            settling=None,
            precision=None,
            max_iterations=5000,
        )

    def loose(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Of samples for a first impression.

        By the energy: they are far from settling, and what counts is how far.
        """
        tolerance = max(self.usual.tolerance or 0.0, problem.solving.loose_tolerance)
        return replace(self.usual, tolerance=tolerance, settling=None, soft_modes=False)

    def counting(self, before: int, total: int) -> Progress | None:
        """Tells of samples that come after others of a stage."""
        tell = self.progress
        if tell is None:
            return None

        def counted(state: SolveProgress) -> None:
            tell(replace(state, done=before + state.done, total=total))

        return counted
