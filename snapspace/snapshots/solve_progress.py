"""SolveProgress: the progress of a run of samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class SolveProgress:
    """The report that `solve_snapshots` passes to its `progress` callable.

    done, total : numbers of finished samples and of all samples
    seconds : time since the run began
    solved : number of samples that this run has solved; the others were finished before
    held_out_error : relative error, in the M-norm, of projecting the newest samples onto the best
        subspace of the samples before them, as the median over the newest block. None before the
        second block is finished. It estimates the error of the subspace at unseen parameters.
    """

    done: int
    total: int
    seconds: float
    solved: int
    held_out_error: float | None = None

    @property
    def rate(self) -> float | None:
        """Samples per second in this run; None before the first."""
        return self.solved / self.seconds if self.solved and self.seconds > 0 else None

    @property
    def eta(self) -> float | None:
        """Seconds for the remaining samples at this rate; None before the first sample."""
        return None if self.rate is None else (self.total - self.done) / self.rate


Progress = Callable[[SolveProgress], None]
