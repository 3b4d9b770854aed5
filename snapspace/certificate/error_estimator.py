"""ErrorEstimator: from what a frame shows to what it hides, calibrated on solved samples."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .local_ratios import LocalRatios
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ErrorEstimator:
    """True errors of a model's frames over one or two indicators, on samples it never saw.

    Errors are root mean square distances, in the mesh's length unit.

    mass : of the body at density 1, its volume
    sample : where residuals are read
    coordinates : (k, d) of the frames
    residual_ratios : (k,) true distances over sampled residuals
    movement_ratios : (k,) true distances over those that a polish moves, or None if that was not
        measured: there are no thorough certificates then

    Raises
    ------
    ValueError
        For fewer than two frames, numbers that are not finite or ratios that are not positive.
    """

    mass: float
    sample: ResidualSample
    coordinates: FloatArray
    residual_ratios: FloatArray
    movement_ratios: FloatArray | None = None

    def __post_init__(self) -> None:
        frames = self.coordinates.shape[:1]
        fine = self.coordinates.ndim == 2 and frames[0] >= 2 and np.isfinite(self.coordinates).all()
        measured = (self.residual_ratios, self.movement_ratios)
        for ratios in (ratios for ratios in measured if ratios is not None):
            fine = fine and ratios.shape == frames and bool(np.isfinite(ratios).all())
            fine = fine and bool((ratios > 0).all())
        if not (fine and self.mass > 0):
            raise ValueError(
                "ErrorEstimator: a calibration has two frames or more, and for each of them finite "
                "coordinates and positive ratios; calibrate the model again"
            )

    @property
    def dimension(self) -> int:
        """d of the model that was measured."""
        return int(self.coordinates.shape[1])

    @cached_property
    def of_residual(self) -> LocalRatios:
        """Ratios for sampled residuals."""
        return LocalRatios(self.coordinates, self.residual_ratios)

    @cached_property
    def of_movement(self) -> LocalRatios:
        """Ratios for what a polish moves; ValueError if they were not measured."""
        if self.movement_ratios is None:
            raise ValueError(
                "certificate: the model was calibrated for quick certificates only; "
                "snapspace.calibrate(model) measures what a polish moves, too"
            )
        return LocalRatios(self.coordinates, self.movement_ratios)
