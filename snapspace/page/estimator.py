"""What the page needs for certificates, small enough to travel inside of it."""

from __future__ import annotations

import numpy as np

from ..certificate import BlendingProbe, PosingProbe, ResidualProbe
from ..model_file.container import Arrays
from ..reduction import InterpolationModel, PosingModel


def estimator_arrays(model: PosingModel | InterpolationModel) -> Arrays:
    """The tets around the sampled vertices with their modes, and the calibration; none without one.

    Modes are in single precision: 16-bit integers would drown small residuals in their rounding.
    """
    estimator = model.error_estimator
    if estimator is None:
        return {}
    subspace, sample = model.subspace, estimator.sample
    arrays: Arrays = {}
    probe: ResidualProbe
    if isinstance(model, PosingModel):
        probe = pins = PosingProbe(model.problem, subspace, sample)
        rests = model.problem.mesh.vertices[None]
        arrays = {
            "estimator_pin_corners": pins.pinned.astype(np.int32),
            "estimator_pin_handles": pins.handles.astype(np.int32),
            "estimator_pin_pulls": pins.pulls[:, 0],
        }
    else:
        probe = BlendingProbe(model.problem, subspace, sample)
        poses = model.problem.pose_shapes
        rests = poses.reshape(len(poses), -1, 3)
    modes = subspace.basis.T.reshape(model.dimension, -1, 3)[:, probe.corners]
    return arrays | {
        "estimator_mass": np.array([estimator.mass]),
        "estimator_rests": np.ascontiguousarray(rests[:, probe.corners]),
        "estimator_base": subspace.tau.reshape(-1, 3)[probe.corners],
        "estimator_modes": modes.reshape(model.dimension, -1).astype(np.float32),
        "estimator_tets": probe.tets,
        "estimator_places": probe.places.astype(np.int32),
        "estimator_weights": probe.weights,
        "estimator_coordinates": estimator.coordinates.astype(np.float32),
        "estimator_ratios": estimator.residual_ratios,
    }
