"""The lowest known full solutions: those of several starts, of which the lowest in energy is kept.

St.Venant-Kirchhoff bodies have many minima, and which one a solve ends in is up to its start. The
starts here are the rest shape, the nearest training samples, and whatever the caller adds.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import snapspace as ss
from snapspace.session.motion_space import MotionSpace
from snapspace.snapshots import DisplacementRows, SampleReport

#: Training samples that are starts, the nearest in the metric of the handles' energy.
NEAREST = 4
TIGHT = ss.SolverOptions(tolerance=1e-9, max_iterations=5000)


def lowest_solutions(
    model: ss.PosingModel, snapshots: ss.Snapshots, reference: ss.Snapshots, shapes: np.ndarray
) -> np.ndarray:
    """Displacements (k, 3n) of the lowest full solutions known at the reference's parameters.

    Of the reference itself and of tight solutions that start from rest, from the nearest of the
    model's training snapshots, and from shapes (k, 3n), for example reduced solutions.
    """
    best = reference.displacements.array()
    values = np.array([report.value for report in reference.reports])
    for starts in [shapes, *_starts(model, snapshots, reference)]:
        found = solved_from(reference, starts)
        for k, report in enumerate(found.reports):
            if report.converged and report.value < values[k]:
                values[k], best[k] = report.value, found.displacements[k]
    return best


def solved_from(reference: ss.Snapshots, starts: np.ndarray) -> ss.Snapshots:
    """Tight solutions at the reference's parameters from displacements (k, 3n)."""
    problem = reference.problem
    reports = [SampleReport("carried", 0, 0, 0.0, 0.0, 0.0, 0.0, 0)] * len(starts)
    rows = DisplacementRows(starts, problem.base.size)
    # a known shape at a sample's own parameters is what its start is interpolated to
    known = ss.Snapshots(problem, reference.parameters, rows, reports)
    return ss.solve_snapshots(problem, reference.parameters, options=TIGHT, known=known)


def _starts(
    model: ss.PosingModel, snapshots: ss.Snapshots, reference: ss.Snapshots
) -> Iterator[np.ndarray]:
    problem, motions = reference.problem, MotionSpace(model)
    yield np.zeros((len(reference), problem.base.size))
    distances = [motions.to_samples(problem.offsets(w)) for w in reference.parameters]
    nearest = np.argsort(distances, axis=1, kind="stable")
    for column in nearest[:, :NEAREST].T:
        yield np.array([snapshots.displacements[int(k)] for k in column])
