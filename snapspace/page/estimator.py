"""The arrays that the page needs for certificates, small enough to be embedded in it."""

from __future__ import annotations

import numpy as np

from ..certificate import BlendingProbe, PosingProbe, ResidualProbe
from ..model_file.container import Arrays
from ..reduction import InterpolationModel, PosingModel


def estimator_arrays(model: PosingModel | InterpolationModel) -> Arrays:
    """The tets around the sampled vertices with their modes, and the calibration.

    Empty if the model is not calibrated. Modes are in single precision: the rounding of 16-bit
    integers would hide small residuals.
    """
    estimator = model.error_estimator
    if estimator is None:
        return {}
    subspace, sample = model.subspace, estimator.sample
    arrays: Arrays = {}
    probe: ResidualProbe
    if isinstance(model, PosingModel):
        probe = PosingProbe(model.problem, subspace, sample)
        arrays = {
            "estimator_pin_corners": probe.pinned,
            "estimator_pin_handles": probe.handles,
            "estimator_pin_pulls": probe.pulls,
        }
    else:
        probe = BlendingProbe(model.problem, subspace, sample)
    modes = subspace.basis.T.reshape(model.dimension, -1, 3)[:, probe.corners]
    return arrays | {
        "estimator_mass": np.array([estimator.mass]),
        "estimator_rests": probe.rests,
        "estimator_base": subspace.tau.reshape(-1, 3)[probe.corners],
        "estimator_modes": modes.reshape(model.dimension, -1).astype(np.float32),
        "estimator_tets": probe.tets,
        "estimator_moduli": probe.material.moduli,
        "estimator_places": probe.places,
        "estimator_weights": probe.weights,
        "estimator_coordinates": estimator.coordinates.astype(np.float32),
        "estimator_ratios": estimator.residual_ratios,
        "estimator_exponent": np.array([estimator.exponent]),
    }
