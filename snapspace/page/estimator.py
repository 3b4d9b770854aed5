"""The arrays that the page needs for certificates, small enough to be embedded in it."""

from __future__ import annotations

import numpy as np

from ..certificate import ElementProbe, StarProbe, residual_probe
from ..model_file.container import Arrays
from ..reduction import InterpolationModel, PosingModel
from ..subspace import AffineSubspace


def estimator_arrays(model: PosingModel | InterpolationModel) -> Arrays:
    """The arrays for the gradient at the sampled vertices, and the calibration.

    Empty if the model is not calibrated. Modes are in single precision: the rounding of 16-bit
    integers would hide small residuals.
    """
    estimator = model.error_estimator
    if estimator is None:
        return {}
    probe = residual_probe(model.problem, model.subspace, estimator.sample)
    arrays: Arrays = {
        "estimator_mass": np.array([estimator.mass]),
        "estimator_weights": probe.weights,
        "estimator_moduli": probe.material.moduli,
        "estimator_coordinates": estimator.coordinates.astype(np.float32),
        "estimator_ratios": estimator.residual_ratios,
        "estimator_exponent": np.array([estimator.exponent]),
    }
    if isinstance(model, PosingModel):
        arrays |= {
            "estimator_pin_corners": probe.pins.pinned,
            "estimator_pin_handles": probe.pins.handles,
            "estimator_pin_pulls": probe.pins.pulls,
            "estimator_pin_arms": probe.pins.arms,
        }
    if isinstance(probe, StarProbe):
        return arrays | _star_arrays(probe)
    return arrays | _element_arrays(probe, model.subspace)


def _element_arrays(probe: ElementProbe, subspace: AffineSubspace) -> Arrays:
    """The tets around the sampled vertices, with their modes."""
    d = subspace.dimension
    modes = subspace.basis.T.reshape(d, -1, 3)[:, probe.corners]
    return {
        "estimator_rests": probe.rests,
        "estimator_base": subspace.tau.reshape(-1, 3)[probe.corners],
        "estimator_modes": modes.reshape(d, -1).astype(np.float32),
        "estimator_tets": probe.tets,
        "estimator_places": probe.places,
    }


def _star_arrays(probe: StarProbe) -> Arrays:
    """The numbers of the stars around the sampled vertices."""
    return {
        "estimator_origins": probe.origins,
        "estimator_modes": probe.modes,
        "estimator_part_stars": probe.part_stars,
        "estimator_part_places": probe.part_places,
        "estimator_part_vectors": probe.part_vectors,
    }
