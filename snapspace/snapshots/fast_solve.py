"""The fast solver on a batch of samples, with a second try for the slow ones."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import Problem, lane_count
from .snapshots import SampleReport

FloatArray = NDArray[np.float64]


def solve_fast(
    problem: Problem,
    inputs: FloatArray,
    starts: FloatArray,
    control: core.SolveControl,
    *,
    tolerance: float,
    max_iterations: int,
    threads: int,
    wave: int,
) -> tuple[FloatArray, list[SampleReport]]:
    """Displacements (k, 3n) and reports by L-BFGS, samples in lanes.

    A sample that has used up the problem's patience goes on alone, on a factor made for the shape
    that it has reached. What a sample goes through does not depend on the others of the call.

    Parameters
    ----------
    problem : Problem
    inputs : (k, input_size); starts : (k, 3n) displacements
    control : SolveControl
        Cancelled samples have the status cancelled.
    tolerance, max_iterations, threads : as in `SolverOptions`; 0 threads are all
    wave : int
        Number of samples from which the width of the packs follows.
    """
    options: dict[str, Any] = {"tolerance": tolerance, "threads": threads, "control": control}
    patience = problem.patience or max_iterations
    batch = problem.system.solve_fast(
        inputs,
        starts,
        max_iterations=min(patience, max_iterations),
        lanes=lane_count(wave),
        **options,
    )
    shapes, reports = batch.shapes, [as_sample_report(report) for report in batch.reports]
    for k in range(len(reports)):
        while reports[k].status == "max_iterations" and reports[k].iterations < max_iterations:
            if control.cancelled:
                reports[k] = replace(reports[k], status="cancelled")
                break
            again = problem.system_near(shapes[k]).solve_fast(
                inputs[k : k + 1],
                shapes[k : k + 1],
                max_iterations=min(patience, max_iterations - reports[k].iterations),
                lanes=lane_count(1),
                **options,
            )
            shapes[k] = again.shapes[0]
            reports[k] = _continued(reports[k], as_sample_report(again.reports[0]))
    return shapes, reports


def as_sample_report(report: core.SolveReport) -> SampleReport:
    """The core's report with the status as a word."""
    return SampleReport(
        status=report.status.name,
        iterations=report.iterations,
        evaluations=report.evaluations,
        value=report.value,
        gradient_norm=report.gradient_norm,
        decrement=report.decrement,
        seconds=report.seconds,
        inverted_tets=report.inverted_tets,
    )


def _continued(before: SampleReport, after: SampleReport) -> SampleReport:
    return replace(
        after,
        iterations=before.iterations + after.iterations,
        evaluations=before.evaluations + after.evaluations,
        seconds=before.seconds + after.seconds,
    )
