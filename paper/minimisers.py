"""Reduced minimisers with the energy of all tets, from the projection of the full solution."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.mesh import mass_norms
from snapspace.reduction import FullBlends, FullEnergy

FloatArray = NDArray[np.float64]

#: Up to this dimension, and from this many solves on, a St.Venant-Kirchhoff energy is made an exact
#: quartic: it is the same, and its coefficients take less time than they save.
MOST_EXACT, LEAST_SOLVES = 60, 5


def minimisers(
    subspace: ss.AffineSubspace,
    reference: ss.Snapshots,
    *,
    tolerance: float = 1e-7,
    model: ss.PosingModel | ss.InterpolationModel | None = None,
) -> Iterator[FloatArray]:
    """Shapes (3n,) that minimise the objective in a subspace, one for each full solution.

    As in the paper (sec. 7): the minimisation begins at the M-projection of the full solution, and
    no evaluation is approximated, so that only subspaces are compared. A model with the exact
    energy on the subspace, if there is one, saves making another.
    """
    problem = reference.problem
    assert isinstance(problem, ss.PosingProblem | ss.InterpolationProblem)
    pays = subspace.dimension <= MOST_EXACT and len(reference) >= LEAST_SOLVES
    exact = problem.material.exact_degree == 4 and pays
    if model is None or model.cubature is not None:
        model = ss.reduce(problem, subspace, energy="exact" if exact else "full")
    for q in coordinates_of_minimisers(model, reference, tolerance=tolerance):
        yield model.subspace.shape(q)


def coordinates_of_minimisers(
    model: ss.PosingModel | ss.InterpolationModel,
    reference: ss.Snapshots,
    *,
    tolerance: float = 1e-7,
) -> Iterator[FloatArray]:
    """Coordinates (d,) where the minimisation of a model's objective ends, from the same starts.

    Newton's method, as in the paper, or with the energy of all tets BFGS from a Hessian's factor:
    it ends at the same minimisers, in a third of the time.
    """
    problem = model.problem
    is_full = isinstance(model, ss.PosingModel) and isinstance(model.elastic, FullEnergy)
    is_full |= isinstance(model, ss.InterpolationModel) and isinstance(model.blends, FullBlends)
    session = model.session(
        tolerance=tolerance,
        minimizer="bfgs" if is_full else "newton",
        max_iterations=3000,
        max_evaluations=5000,
    )
    for parameters, shape in zip(reference.parameters, reference.shapes, strict=True):
        start = model.subspace.coordinates(shape)
        if isinstance(session, ss.BlendingSession):
            session.put(parameters, start)
        else:
            assert isinstance(problem, ss.PosingProblem)
            offsets = problem.offsets(parameters)
            session.put([(o[:, :3] + np.eye(3), o[:, 3]) for o in offsets], start)
        report = session.solve()
        if report.status not in ("converged", "line_search_failed"):
            raise ValueError(f"minimisers: a reduced solve ended as {report.status}")
        yield session.q


def relative_errors(
    subspace: ss.AffineSubspace,
    reference: ss.Snapshots,
    *,
    model: ss.PosingModel | ss.InterpolationModel | None = None,
) -> FloatArray:
    """|x_red - x_full|_M over |x_full - tau|_M of all full solutions, (k,)."""
    shapes = reference.shapes
    found = np.array(list(minimisers(subspace, reference, model=model)))
    size = mass_norms(subspace.mass, shapes - subspace.tau)
    errors: FloatArray = mass_norms(subspace.mass, found - shapes) / size
    return errors


def projection_errors(subspace: ss.AffineSubspace, reference: ss.Snapshots) -> FloatArray:
    """The same of the M-projections of the full solutions, the least that is possible, (k,)."""
    shapes = reference.shapes
    away = shapes - subspace.tau
    miss = away - subspace.coordinates(shapes) @ subspace.basis.T
    errors: FloatArray = mass_norms(subspace.mass, miss) / mass_norms(subspace.mass, away)
    return errors
