"""SampleValues: blended energies of training samples, for comparison with the frames of a drag."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class SampleValues:
    """The reduced energies of training samples for any weights of the poses.

    The energy is linear in the weights, so each sample is evaluated only once for every pose.

    Parameters
    ----------
    loop : a blending loop
        Evaluates the energy in its present dimension d.
    coordinates : (k, d)
        Reduced coordinates of the samples.
    poses : int
    """

    def __init__(self, loop: Any, coordinates: FloatArray, poses: int) -> None:
        self._loop = loop
        self._coordinates = coordinates
        self._of_poses = np.full((len(coordinates), poses), np.nan)

    @property
    def dimension(self) -> int:
        """d."""
        dimension: int = self._coordinates.shape[1]
        return dimension

    def __call__(self, sample: int, weights: FloatArray) -> float:
        """Energy of a sample. The loop must have these weights (poses,), and keeps them."""
        own, used = self._of_poses[sample], weights != 0.0
        missing = np.flatnonzero(used & np.isnan(own))
        for pose in missing:
            self._loop.set_weights(np.eye(len(own))[pose])
            own[pose] = self._loop.value_and_gradient(self._coordinates[sample])[0]
        if len(missing):
            self._loop.set_weights(weights)
        return float(own[used] @ weights[used])
