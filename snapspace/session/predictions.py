"""predicted_solutions: a reduced model's solutions for samples that are not solved yet."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_rows
from ..blas import single_threaded_blas
from ..reduction import (
    InterpolationModel,
    PosingModel,
    check_model,
    reduced_solutions,
    solved_sessions,
)
from ..snapshots import Predictions, positive_inverse

FloatArray = NDArray[np.float64]

#: Factor by which Hessians of samples are assumed to be stiffer than the model's. A cubature misses
#: the few elements that are nearly flat or inverted. A seed that is too soft takes steps that are
#: too long: blends of a centaur's surface, d = 57, took 123 evaluations with a factor of 1, 74 with
#: 2 and 54 with 4, as many as with the exact Hessian; on the Lion 30.
STIFFER = 4.0
#: Tolerance of a prediction with Hessians: full solves begin in the same coordinates, with the same
#: Hessians.
TOLERANCE = 1e-7


@single_threaded_blas
def predicted_solutions(
    model: PosingModel | InterpolationModel,
    parameters: ArrayLike,
    *,
    hessians: bool | None = None,
) -> Predictions:
    """The model's solutions for parameters (k, p), for `solve_snapshots`.

    A prediction does not depend on the others. Its tolerance is 1e-7 with Hessians, and that of
    sessions without.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    parameters : (k, p)
    hessians : bool, optional
        Whether to predict Hessians as well. They pay off for motions that take more than 110
        evaluations. Default: yes, except for blends, which gain nothing.

    Raises
    ------
    ValueError
        For something other than a model, or parameters of another shape.
    """
    check_model(model, "predicted_solutions")
    parameters = as_rows("predicted_solutions", "parameters", parameters)
    if hessians is None:
        hessians = model.problem.solving.seeded_hessians
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
