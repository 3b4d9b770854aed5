"""Solving: how samples are solved, and who gets their progress."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass, replace

from ..problem import InterpolationProblem, PosingProblem
from ..reduction import training_tolerance
from ..snapshots import Checkpoint, Progress, SolveProgress, SolverOptions
from .plan import is_large, plan_of


@dataclass(frozen=True, kw_only=True)
class Solving:
    """Arguments as for `solve_snapshots`, for the samples of all stages.

    progress : counts all samples of a stage, including those of earlier stages
    """

    options: SolverOptions | None = None
    threads: int | None = None
    progress: Progress | None = None
    checkpoint: Checkpoint | None = None
    executor: Executor | None = None

    def chosen(
        self, problem: PosingProblem | InterpolationProblem, *, judging: bool, predicted: bool
    ) -> SolverOptions:
        """Options for samples that are held out; otherwise for predicted samples, or others."""
        if judging:
            return self.judging(problem)
        return self.seeded(problem) if predicted else self.usual(problem)

    def usual(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Options for training samples."""
        tight = self._tight(problem)
        if self._decided or tight.tolerance is None or not is_large(problem):
            return tight
        return replace(tight, tolerance=tight.tolerance * plan_of(problem).looser_if_large)

    def seeded(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Options for training samples that a model predicts: looser where that is good enough."""
        usual, seeded = self.usual(problem), problem.solving.seeded_tolerance
        if seeded is None or self._decided:
            return usual
        return replace(usual, tolerance=max(seeded, usual.tolerance or 0.0))

    def judging(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Options for held-out samples.

        They are solved more tightly: along soft modes the error of a training sample may be as
        large as that of a model. With a tenth of the tolerance, held-out blends of five sets of
        solids are 0.0001 to 0.0004 off on average.
        """
        tight = self._tight(problem)
        return replace(
            tight,
            tolerance=plan_of(problem).held_out_tolerance * tight.resolved(problem).tolerance,
            settling=None,
            precision=None,
            max_iterations=max(tight.max_iterations, SolverOptions.max_iterations),
        )

    @property
    def _decided(self) -> bool:
        """Whether the user decides how tightly samples are solved."""
        given = self.options
        return given is not None and (given.tolerance, given.settling) != (None, None)

    def _tight(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """The user's options, with the tolerance that the energy needs unless they set one."""
        given = self.options or SolverOptions()
        if self._decided:
            return given
        return replace(
            given, tolerance=training_tolerance(problem, plan_of(problem).most_dimensions)
        )

    def loose(self, problem: PosingProblem | InterpolationProblem) -> SolverOptions:
        """Options for samples of a preliminary model.

        Their termination test is that of the energy: they are far from settled, and only the
        distance matters.
        """
        usual = self.usual(problem)
        tolerance = max(usual.tolerance or 0.0, problem.solving.loose_tolerance)
        return replace(usual, tolerance=tolerance, settling=None, soft_modes=False)

    def counting(self, before: int, total: int) -> Progress | None:
        """The progress callback for samples that follow `before` others of a stage."""
        progress = self.progress
        if progress is None:
            return None

        def counted(state: SolveProgress) -> None:
            progress(replace(state, done=before + state.done, total=total))

        return counted
