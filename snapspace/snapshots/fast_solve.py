"""solve_fast: the fast solver on samples, with a second try for slow ones."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import Problem
from .snapshots import SampleReport
from .solver_options import ResolvedOptions

FloatArray = NDArray[np.float64]


def solve_fast(
    problem: Problem,
    inputs: FloatArray,
    starts: FloatArray,
    control: core.SolveControl,
    options: ResolvedOptions,
    *,
    threads: int,
    coarse: core.CoarseSpace | None = None,
) -> tuple[FloatArray, list[SampleReport]]:
    """Displacements (k, 3n) and reports of L-BFGS solves, with samples in SIMD lanes.

    The result of a sample does not depend on the other samples of the call.

    Parameters
    ----------
    problem : Problem
    inputs : (k, input_size), followed by the inverses of predictions; starts : (k, 3n)
        displacements
    control : SolveControl
        Cancelled samples have the status cancelled.
    options : ResolvedOptions
    threads : int
        Number of threads, 0 for all.
    coarse : CoarseSpace, optional
        The space of predictions, which replaces the soft modes.
    """
    batch = problem.system.solve_fast(
        inputs,
        starts,
        tolerance=options.tolerance,
        max_iterations=first_iterations(problem, options),
        threads=threads,
        control=control,
        single=options.single,
        settling=options.settling,
        **seed_of(problem, options, coarse),
    )
    shapes, reports = batch.shapes, [as_sample_report(report) for report in batch.reports]
    for k, report in enumerate(reports):
        if needs_another_try(report, options):
            shapes[k], reports[k] = continue_solving(
                problem, inputs[k], shapes[k], report, control, options, threads=threads
            )
    return shapes, reports


def seed_of(
    problem: Problem, options: ResolvedOptions, coarse: core.CoarseSpace | None
) -> dict[str, Any]:
    """The low-rank part of the seed, as arguments of the core's solves."""
    return {"coarse": coarse} if coarse is not None else {"modes": options.modes_of(problem)}


def first_iterations(problem: Problem, options: ResolvedOptions) -> int:
    """Iterations of a sample on the factor that all samples share."""
    return min(problem.solving.patience or options.max_iterations, options.max_iterations)


def needs_another_try(report: SampleReport, options: ResolvedOptions) -> bool:
    """Whether a sample has iterations left, but used up the problem's patience, or got stuck.

    On soft bodies the rounding of single precision may stop a sample before it converges.
    """
    stuck = options.single and report.status == "line_search_failed"
    slow = report.status == "max_iterations"
    return (slow or stuck) and report.iterations < options.max_iterations


def continue_solving(
    problem: Problem,
    inputs: FloatArray,
    shape: FloatArray,
    report: SampleReport,
    control: core.SolveControl,
    options: ResolvedOptions,
    *,
    threads: int,
) -> tuple[FloatArray, SampleReport]:
    """Continues one sample alone, on factors made for the shapes that it reaches.

    Only the system's part of inputs (input_size,) is used. Shape (3n,) and report are those reached
    so far. Returns the final ones. A sample that got stuck continues in double precision.
    """
    traits = problem.solving
    while needs_another_try(report, options):
        if report.status == "line_search_failed":
            options = replace(options, single=False)
        if control.cancelled:
            return shape, replace(report, status="cancelled")
        left = options.max_iterations - report.iterations
        again = traits.system_near(shape).solve_fast(
            inputs[None, : problem.system.input_size],
            shape[None],
            tolerance=options.tolerance,
            max_iterations=min(traits.patience or left, left),
            threads=threads,
            control=control,
            single=options.single,
            settling=options.settling,
            modes=options.modes_of(problem),
        )
        shape, report = again.shapes[0], _continued(report, as_sample_report(again.reports[0]))
    return shape, report


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
