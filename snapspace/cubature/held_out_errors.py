"""Errors of a cubature at solutions that it was not trained on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from .state_forces import StateForces

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class CubatureErrors:
    """Medians and maxima over held-out states, compared with the energy of all tets.

    states : number of states
    energy_* : |E_c - E| / E
    force_* : |f_c - f| / |f| of the reduced elastic forces
    displacement_* : |C (f_c - f)| / |q| with the compliance C of the state: about how far the
        cubature's error moves a solution, relative to its displacement
    """

    states: int
    energy_median: float
    energy_max: float
    force_median: float
    force_max: float
    displacement_median: float
    displacement_max: float

    def as_json(self) -> dict[str, float]:
        """The numbers by name."""
        return asdict(self)


def held_out_errors(
    coordinates: FloatArray,
    exact: StateForces,
    cubature: Callable[[int], tuple[float, FloatArray]],
    compliances: FloatArray,
) -> CubatureErrors:
    """Errors of a cubature at s >= 1 states.

    coordinates : (s, d), the reduced states
    exact : forces and energies of all tets at the states
    cubature : called with a state's index, returns its energy and gradient (d,)
    compliances : (s, d, d), of the states
    """
    sizes = np.linalg.norm(coordinates, axis=1)
    sizes = np.maximum(sizes, 1e-3 * sizes.max())  # a blend may be the mean shape itself
    errors = np.empty((len(coordinates), 3))
    for k, (target, force, size) in enumerate(zip(errors, exact.forces, sizes, strict=True)):
        value, gradient = cubature(k)
        target[0] = abs(value - exact.energies[k]) / exact.units[k]
        target[1] = np.linalg.norm(gradient - force) / np.linalg.norm(force)
        target[2] = np.linalg.norm(compliances[k] @ (gradient - force)) / max(size, 1e-300)
    median, worst = np.median(errors, axis=0).tolist(), errors.max(axis=0).tolist()
    return CubatureErrors(
        len(coordinates), median[0], worst[0], median[1], worst[1], median[2], worst[2]
    )
