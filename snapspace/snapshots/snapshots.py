"""Snapshots: full-space solutions of sampled parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..problem import Problem

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class SampleReport:
    """How the full-space solve of one sample ended.

    status is one of converged, max_iterations, line_search_failed, not_finite; value is the
    objective F at the shape, gradient_norm the Euclidean norm of its gradient, decrement twice the
    decrease that the solver's model still predicted, seconds the wall time, inverted_tets the
    number of tets with det F <= 0.
    """

    status: str
    iterations: int
    evaluations: int
    value: float
    gradient_norm: float
    decrement: float
    seconds: float
    inverted_tets: int

    @property
    def converged(self) -> bool:
        """Whether the solver's test was met."""
        return self.status == "converged"


@dataclass(frozen=True)
class Snapshots:
    """Solutions of a problem at sampled parameters.

    problem : Problem
    parameters : (k, p), one sample per row
    shapes : (3n, k), one shape per column, positions x0 y0 z0 x1 ...
    reports : one SampleReport per sample
    """

    problem: Problem
    parameters: FloatArray
    shapes: FloatArray
    reports: Sequence[SampleReport]

    def __len__(self) -> int:
        return len(self.reports)

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Mask (k,) of the samples that met the solver's test."""
        return np.array([report.converged for report in self.reports], dtype=bool)

    def select(self, which: NDArray[np.bool_]) -> Snapshots:
        """The samples of a mask (k,)."""
        reports = [report for report, keep in zip(self.reports, which, strict=True) if keep]
        return Snapshots(self.problem, self.parameters[which], self.shapes[:, which], reports)

    def summary(self) -> str:
        """One line: how many converged, why others did not, iterations, inverted tets."""
        good = int(self.converged.sum())
        parts = [f"{good} of {len(self)} samples converged"]
        for status in sorted({r.status for r in self.reports if not r.converged}):
            parts.append(f"{sum(r.status == status for r in self.reports)} {status}")
        parts.append(f"{np.mean([r.iterations for r in self.reports]):.0f} iterations on average")
        parts.append(f"at most {max(r.inverted_tets for r in self.reports)} inverted tets")
        return ", ".join(parts)
