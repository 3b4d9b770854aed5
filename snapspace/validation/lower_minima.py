"""with_lower_minima: full solutions that are the lowest known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..reduction import ReducedModel
from ..snapshots import SampleReport, Snapshots, SolverOptions, solve_snapshots
from .unseen import reference_options

FloatArray = NDArray[np.float64]

#: Steps of descent from a frame, which is stiffer than the body and so above its own minimum.
STEPS = 30
#: What is below by less than this share of the energy is rounding, or not solved as tightly.
RESOLVED = 1e-6


def with_lower_minima(
    model: ReducedModel, reference: Snapshots, *, threads: int | None = None
) -> tuple[Snapshots, int]:
    """Full solutions, solved again where frames of a model lead below them.

    An energy may have several minima, and a solve from one start need not find the lowest. Thirty
    steps go down from every frame in the full space. Where they come below the full solution, it is
    not the lowest one, and is solved again from where they ended.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    reference : Snapshots
        Tight full solutions of its problem.
    threads : int, optional
        Default: all. The result does not depend on it.

    Returns
    -------
    reference : Snapshots
        The same samples; none has more energy than before.
    lower : int
        How many have less.

    Notes
    -----
    Nothing is below an only minimum, so that errors to a unique solution never change.
    """
    parameters, threshold = reference.parameters, _values(reference)
    threshold -= RESOLVED * np.abs(threshold)
    options = reference_options(model.problem)
    begun = _solved_from(
        model,
        parameters,
        _frames(model, parameters),
        replace(options, max_iterations=STEPS),
        threads,
    )
    below = _values(begun) < threshold
    if not below.any():
        return reference, 0
    shapes = begun.select(below).shapes.T
    again = _solved_from(model, parameters[below], shapes, options, threads)
    rows, reports = list(reference.displacements), list(reference.reports)
    lower = 0
    for i, row, report in zip(
        np.flatnonzero(below), again.displacements, again.reports, strict=True
    ):
        if report.converged and report.value < threshold[i]:
            rows[i], reports[i] = row, report
            lower += 1
    displacements = DisplacementRows(rows, model.problem.base.size)
    return Snapshots(model.problem, parameters, displacements, reports), lower


def _values(snapshots: Snapshots) -> FloatArray:
    return np.array([report.value for report in snapshots.reports])


def _frames(model: ReducedModel, parameters: FloatArray) -> FloatArray:
    """Shapes (k, 3n) of reduced solves from tau."""
    session = model.session()
    shapes = np.empty((len(parameters), model.problem.base.size))
    for shape, w in zip(shapes, parameters, strict=True):
        session.reset()
        session.set_parameters(w)
        shape[:] = model.subspace.shape(session.q)
    return shapes


def _solved_from(
    model: ReducedModel,
    parameters: FloatArray,
    shapes: FloatArray,
    options: SolverOptions,
    threads: int | None,
) -> Snapshots:
    """Full solutions from given shapes (k, 3n)."""
    problem = model.problem
    guess = SampleReport("carried", 0, 0, 0.0, 0.0, 0.0, 0.0, 0)
    starts = Snapshots.from_shapes(problem, parameters, shapes.T, [guess] * len(shapes))
    return solve_snapshots(problem, parameters, options=options, threads=threads, known=starts)
