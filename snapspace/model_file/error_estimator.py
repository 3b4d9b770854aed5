"""Error estimators as arrays; a model without an estimator has none of these arrays."""

from __future__ import annotations

import numpy as np

from ..certificate import ErrorEstimator, ResidualSample
from .container import Arrays

DTYPES: dict[str, type] = {
    "estimator_mass": np.float64,
    "estimator_vertices": np.int32,
    "estimator_weights": np.float64,
    "estimator_coordinates": np.float64,
    "estimator_residual_ratios": np.float64,
}
#: Only in estimators that give thorough certificates.
MOVEMENT = "estimator_movement_ratios"
#: Exponent of the residual. Files of older calibrations lack it, and then it is 1.
EXPONENT = "estimator_exponent"
OPTIONAL: dict[str, type] = {MOVEMENT: np.float64, EXPONENT: np.float64}


def estimator_arrays(estimator: ErrorEstimator | None) -> Arrays:
    """The arrays of an estimator; the names are those of DTYPES."""
    if estimator is None:
        return {}
    arrays = {
        "estimator_mass": np.array([estimator.mass]),
        "estimator_vertices": estimator.sample.vertices,
        "estimator_weights": estimator.sample.weights,
        "estimator_coordinates": estimator.coordinates,
        "estimator_residual_ratios": estimator.residual_ratios,
        EXPONENT: np.array([estimator.exponent]),
    }
    if estimator.movement_ratios is not None:
        arrays[MOVEMENT] = estimator.movement_ratios
    return arrays


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of the arrays that a file must have: all of an estimator's if it has any of them."""
    if not any(name in arrays for name in DTYPES | OPTIONAL):
        return {}
    return DTYPES | {name: kind for name, kind in OPTIONAL.items() if name in arrays}


def estimator(arrays: Arrays) -> ErrorEstimator | None:
    """The estimator in a file's arrays, or None; ValueError if the arrays do not match."""
    if not dtypes(arrays):
        return None
    return ErrorEstimator(
        mass=float(arrays["estimator_mass"].item()),
        sample=ResidualSample(arrays["estimator_vertices"], arrays["estimator_weights"]),
        coordinates=arrays["estimator_coordinates"],
        residual_ratios=arrays["estimator_residual_ratios"],
        movement_ratios=arrays.get(MOVEMENT),
        exponent=float(arrays[EXPONENT].item()) if EXPONENT in arrays else 1.0,
    )
