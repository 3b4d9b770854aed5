"""ErrorEstimator: relates indicators of a frame to its true error, calibrated on solved samples."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .local_ratios import LocalRatios
from .residual_growth import rest_size
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ErrorEstimator:
    """Ratios of a model's true errors to one or two indicators, on unseen samples.

    Errors are root mean square distances, in the mesh's length unit.

    mass : mass of the body at density 1, its volume
    sample : the vertices where residuals are read
    coordinates : (k, d), reduced coordinates of the k frames
    residual_ratios : (k,), true distances over size (residual / size)^exponent, with the sampled
        residual and the distance from tau of each frame, see `growth_exponent`
    movement_ratios : (k,), true distances over the distances that a polish moves, or None if these
        were not measured; then there are no thorough certificates
    exponent : exponent of the residual. It is 1 in older calibrations, whose ratios are to the
        residual

    Raises
    ------
    ValueError
        For fewer than two frames, numbers that are not finite, ratios that are not positive or an
        exponent below 1.
    """

    mass: float
    sample: ResidualSample
    coordinates: FloatArray
    residual_ratios: FloatArray
    movement_ratios: FloatArray | None = None
    exponent: float = 1.0

    def __post_init__(self) -> None:
        frames = self.coordinates.shape[:1]
        fine = self.coordinates.ndim == 2 and frames[0] >= 2 and np.isfinite(self.coordinates).all()
        measured = (self.residual_ratios, self.movement_ratios)
        for ratios in (ratios for ratios in measured if ratios is not None):
            fine = fine and ratios.shape == frames and bool(np.isfinite(ratios).all())
            fine = fine and bool((ratios > 0).all())
        if not (fine and self.mass > 0 and 1.0 <= self.exponent < np.inf):
            raise ValueError(
                "ErrorEstimator: a calibration needs at least two frames, each with finite "
                "coordinates and positive ratios, and an exponent of 1 or more; calibrate the "
                "model again"
            )

    def __repr__(self) -> str:
        thorough = "" if self.movement_ratios is None else ", also for polished ones"
        frames = f"{len(self.coordinates)} frames"
        return f"ErrorEstimator(dimension {self.dimension}, calibrated with {frames}{thorough})"

    @property
    def dimension(self) -> int:
        """d of the calibrated model."""
        return int(self.coordinates.shape[1])

    @cached_property
    def rest(self) -> float:
        """The displacement below which frames count as at rest, in the mesh's length unit."""
        return rest_size(self.coordinates, self.mass)

    @cached_property
    def of_residual(self) -> LocalRatios:
        """Ratios for sampled residuals, see `grown`."""
        return LocalRatios(self.coordinates, self.residual_ratios)

    @cached_property
    def of_movement(self) -> LocalRatios:
        """Ratios for how far a polish moves; ValueError if they were not measured."""
        if self.movement_ratios is None:
            raise ValueError(
                "certificate: the model was calibrated for quick certificates only; "
                "snapspace.calibrate(model) also measures how far a polish moves the shape"
            )
        return LocalRatios(self.coordinates, self.movement_ratios)
