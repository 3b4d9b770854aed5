"""predicted_solutions: what a reduced model says of samples before they are solved."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..reduction import InterpolationModel, PosingModel, solved_sessions
from ..snapshots import Predictions, positive_inverse

FloatArray = NDArray[np.float64]

#: Hessians of samples are taken to be so much stiffer than the model's. A cubature misses the few
#: stars that are nearly flat or turned over: between poses of the centaur they make the Hessian of
#: some modes seven times stiffer. A seed that is too soft takes steps that are too long. On the
#: centaur, d = 57, samples take 123 evaluations with 1, 74 with 2 and 54 with 4, as many as with
#: the exact Hessian; on the Lion 30.
STIFFER = 4.0


@single_threaded_blas
def predicted_solutions(
    model: PosingModel | InterpolationModel, parameters: FloatArray
) -> Predictions:
    """The model's solutions for parameters (k, p), for `solve_snapshots`.

    With its Hessians there, if the problem's solves gain by them. A prediction does not depend on
    the others.
    """
    basis, offset = model.subspace.basis, model.problem.base
    size, d = basis.shape
    seeded = model.problem.solving.model_seeds
    displacements = np.empty((len(parameters), size))
    inverses = np.empty((len(parameters), d, d) if seeded else (0, d, d))
    for k, session in enumerate(solved_sessions(model, parameters)):
        displacements[k] = model.subspace.shape(session.q) - offset
        if seeded:
            inverses[k] = positive_inverse(session.hessian()) / STIFFER
    return Predictions(displacements, basis, inverses) if seeded else Predictions(displacements)
