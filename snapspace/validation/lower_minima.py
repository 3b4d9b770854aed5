"""with_lower_minima: full solutions, replaced by lower ones where frames lead to them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..reduction import ReducedModel, solved_shapes
from ..snapshots import SampleReport, Snapshots, SolverOptions, solve_snapshots
from .frame_errors import unseen_errors
from .unseen import reference_options

FloatArray = NDArray[np.float64]

#: A frame closer than this share of the displacement is at the same minimum.
APART = 0.02
#: Descent steps from a frame. A reduced model is stiffer than the body, so the energy of a frame is
#: above the minimum near it.
STEPS = 30
#: Smaller differences, as a share of the energy, are rounding errors or errors of solving.
RESOLVED = 1e-6


def with_lower_minima(
    model: ReducedModel,
    reference: Snapshots,
    *,
    errors: FloatArray | None = None,
    threads: int | None = None,
) -> tuple[Snapshots, int]:
    """Full solutions, solved again where frames of a model lead to lower energies.

    An energy may have several minima, and a solve from one start need not find the lowest. If a
    frame is far from the full solution, thirty steps descend from it in the full space. If they
    reach an energy below that of the full solution, the sample is solved again from there.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    reference : Snapshots
        Tight full solutions of its problem.
    errors : (k,), optional
        Errors of the frames, `unseen_errors`, if they are known.
    threads : int, optional
        Default: all. The result does not depend on it.

    Returns
    -------
    reference : Snapshots
        The same samples; none has a higher energy than before.
    lower : int
        Number of samples with a lower energy.

    Notes
    -----
    Nothing is lower than a unique minimum, so errors against a unique solution never change.
    """
    if errors is None:
        errors = unseen_errors(model, reference)
    apart = np.flatnonzero(errors > APART)
    found = _lower_minima(model, reference, apart, threads=threads) if len(apart) else {}
    if not found:
        return reference, 0
    rows, reports = list(reference.displacements), list(reference.reports)
    for i, (row, report) in found.items():
        rows[i], reports[i] = row, report
    displacements = DisplacementRows(rows, model.problem.base.size)
    return Snapshots(model.problem, reference.parameters, displacements, reports), len(found)


def _lower_minima(
    model: ReducedModel, reference: Snapshots, apart: NDArray[np.intp], *, threads: int | None
) -> dict[int, tuple[FloatArray, SampleReport]]:
    """Displacements (3n,) and reports of minima below samples of a reference, by sample index."""
    values = np.array([reference.reports[i].value for i in apart])
    threshold = values - RESOLVED * np.abs(values)
    parameters, options = reference.parameters[apart], reference_options(model.problem)
    few = replace(options, max_iterations=STEPS)
    begun = _solved_from(model, parameters, solved_shapes(model, parameters), few, threads)
    below = np.array([report.value for report in begun.reports]) < threshold
    if not below.any():
        return {}
    shapes = begun.select(below).shapes
    again = _solved_from(model, parameters[below], shapes, options, threads)
    solved = zip(apart[below], threshold[below], again.displacements, again.reports, strict=True)
    return {
        int(i): (row, report)
        for i, limit, row, report in solved
        if report.converged and report.value < limit
    }


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
    starts = Snapshots.from_shapes(problem, parameters, shapes, [guess] * len(shapes))
    return solve_snapshots(problem, parameters, options=options, threads=threads, known=starts)
