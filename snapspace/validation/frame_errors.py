"""unseen_errors: errors of a model's frames against full solutions."""

from __future__ import annotations

import time
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..mesh import Body, TetMesh, mass_norms, tet_volumes
from ..reduction import ReducedModel, solved_coordinates
from ..session import FrameReport
from ..snapshots import Snapshots, check_snapshots_of
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]


def unseen_errors(model: ReducedModel, reference: Snapshots) -> FloatArray:
    """Errors (k,) of reduced solves from tau against full solutions, as `Validation.error`.

    Raises
    ------
    ValueError
        If the reference is of another problem.
    """
    check_snapshots_of(model.problem, reference, "unseen_errors", "reference")
    return solution_errors(model, reference, solved_coordinates(model, reference.parameters))


def compared(
    model: ReducedModel, reference: Snapshots
) -> tuple[FloatArray, list[tuple[FrameReport, float]], NDArray[np.int64]]:
    """Errors (k,) of frames; reports and milliseconds; inverted tets (k,)."""
    session, mesh = model.session(), model.problem.mesh
    solutions, frames, inverted = [], [], []
    for w in reference.parameters:
        session.reset()
        begin = time.perf_counter()
        report = session.set_parameters(w)
        vertices = session.vertices
        frames.append((report, 1e3 * (time.perf_counter() - begin)))
        inverted.append(_inverted(mesh, vertices))
        solutions.append(session.q.copy())
    errors = solution_errors(model, reference, np.array(solutions))
    return errors, frames, np.array(inverted, np.int64)


def _inverted(mesh: Body, vertices: FloatArray) -> int:
    """Number of tets without positive volume; a shell has none."""
    if not isinstance(mesh, TetMesh):
        return 0
    return int((tet_volumes(vertices, mesh.tets) <= 0).sum())


def solution_errors(model: ReducedModel, reference: Snapshots, solutions: FloatArray) -> FloatArray:
    """Errors (k,) of reduced solutions (k, d), one shape at a time."""
    problem, subspace = model.problem, model.subspace
    rows = _from_tau(model, reference)
    return _relative_errors(
        subspace,
        rows,
        (
            problem.aligned(subspace.shape(solution), subspace.tau + row)
            for row, solution in zip(rows, solutions, strict=True)
        ),
    )


def projection_errors(model: ReducedModel, reference: Snapshots) -> FloatArray:
    """Errors (k,) of the projections of full solutions, one shape at a time."""
    subspace, rows = model.subspace, _from_tau(model, reference)
    projections = (subspace.shape(projection) for projection in subspace.row_coordinates(rows))
    return _relative_errors(subspace, rows, projections)


def _from_tau(model: ReducedModel, reference: Snapshots) -> DisplacementRows:
    """Displacements of full solutions from tau."""
    return reference.displacements.shifted(model.problem.base - model.subspace.tau)


def _relative_errors(
    subspace: AffineSubspace, rows: DisplacementRows, shapes: Iterable[FloatArray]
) -> FloatArray:
    """Distances of shapes (3n,) from tau + row, relative to the rows, (k,)."""
    errors = np.empty(len(rows))
    for k, (row, shape) in enumerate(zip(rows, shapes, strict=True)):
        miss = shape - (subspace.tau + row)
        error, size = mass_norms(subspace.mass, np.stack([miss, row]))
        errors[k] = error / size
    return errors
