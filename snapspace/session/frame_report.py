"""FrameReport: how one frame of a session was solved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class FrameReport:
    """How one frame was solved.

    status : converged, max_iterations, max_evaluations, line_search_failed or not_finite; unbounded
    where an extrapolated blend has no minimum
    iterations, evaluations : steps of the minimiser, and evaluations of the reduced energy
    value : reduced objective F; gradient_norm : Euclidean norm of its gradient by q
    seconds : time of the solve, without computing the vertices
    start : where the solve began: "last frame", "sample" (a training sample of lower energy) or
    "tau"; after `solve_anew`, the start that led to the lowest energy
    """

    status: str
    iterations: int
    evaluations: int
    value: float
    gradient_norm: float
    seconds: float
    start: str = "last frame"

    @classmethod
    def of(cls, report: Any, seconds: float) -> FrameReport:
        """The report of a loop's solve or step that took `seconds`."""
        return cls(
            report.status.name,
            report.iterations,
            report.evaluations,
            report.value,
            report.gradient_norm,
            seconds,
        )

    @property
    def converged(self) -> bool:
        """Whether all three termination tests were met."""
        return self.status == "converged"
