"""predicted_solutions: what a reduced model says of samples before they are solved."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..reduction import InterpolationModel, PosingModel, reduced_solutions, solved_sessions
from ..snapshots import Predictions, positive_inverse

FloatArray = NDArray[np.float64]

#: Hessians of samples are taken to be so much stiffer than the model's. A cubature misses the few
#: stars that are nearly flat or turned over: between poses of the centaur they make the Hessian of
#: some modes seven times stiffer. A seed that is too soft takes steps that are too long. On the
#: centaur, d = 57, samples take 123 evaluations with 1, 74 with 2 and 54 with 4, as many as with
#: the exact Hessian; on the Lion 30.
STIFFER = 4.0
#: Tolerance of a prediction with Hessians: full solves begin in the same coordinates, with the same
#: Hessians. Two Lions, whose models are accurate, then take 19 evaluations (median), as after 1e-9,
#: and 29 after 1e-4. Four and more poses need as many after 1e-4.
TOLERANCE = 1e-7


@single_threaded_blas
def predicted_solutions(
    model: PosingModel | InterpolationModel, parameters: FloatArray, *, hessians: bool = True
) -> Predictions:
    """The model's solutions for parameters (k, p), for `solve_snapshots`.

    A prediction does not depend on the others. With Hessians it has a tolerance of 1e-7, and
    without them that of sessions.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    parameters : (k, p)
    hessians : bool, default True
        Whether to predict Hessians as well. They pay where samples take many evaluations: blends of
        tets, and motions that take fewer than 110, gain nothing by them.
    """
    if not hessians:
        return Predictions(reduced_solutions(model, parameters))
    coordinates = np.empty((len(parameters), model.dimension))
    inverses = np.empty((*coordinates.shape, model.dimension))
    sessions = solved_sessions(model, parameters, tolerance=TOLERANCE)
    for k, session in enumerate(sessions):
        coordinates[k] = session.q
        inverses[k] = positive_inverse(session.hessian()) / STIFFER
    displacements = model.subspace.shapes(coordinates) - model.problem.base
    return Predictions(displacements, model.subspace.basis, inverses)
