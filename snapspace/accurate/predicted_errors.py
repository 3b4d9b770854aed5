"""predicted_errors: what solved samples say of the model that predicted them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..displacements import DisplacementRows
from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Predictions, Snapshots
from ..validation import solution_errors

FloatArray = NDArray[np.float64]


def predicted_errors(
    model: PosingModel | InterpolationModel, predictions: Predictions, solved: Snapshots
) -> FloatArray:
    """Errors (k, 2) of the model's solutions and of projections, of the usable samples.

    The model has not seen these samples, so their ratio is measured before any model is judged.
    """
    usable, subspace = solved.usable, model.subspace
    starts = DisplacementRows(predictions.displacements[usable], subspace.tau.size)
    coordinates = subspace.row_coordinates(starts.shifted(model.problem.base - subspace.tau))
    return solution_errors(model, solved.select(usable), coordinates)
