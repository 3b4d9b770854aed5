"""How well a cubature does on solutions that it was not trained on."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..problem import PosingProblem
from ..subspace import AffineSubspace
from .cubature import Cubature

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class CubatureErrors:
    """Medians and maxima over held-out states, against the energy of all tets.

    states : how many
    energy_* : |E_c - E| / E
    force_* : |f_c - f| / |f| of the reduced elastic forces
    displacement_* : |C (f_c - f)| / |q| with the compliance C at rest: about how far the cubature
    alone moves a solution, relative to its displacement
    """

    states: int
    energy_median: float
    energy_max: float
    force_median: float
    force_max: float
    displacement_median: float
    displacement_max: float

    def as_json(self) -> dict[str, float]:
        """The figures by name."""
        return asdict(self)


@single_threaded_blas
def held_out_errors(
    problem: PosingProblem,
    subspace: AffineSubspace,
    cubature: Cubature,
    states: FloatArray,
    compliance: FloatArray,
) -> CubatureErrors:
    """Errors at reduced states (s, d), s >= 1."""
    errors = np.empty((len(states), 3))
    for target, q in zip(errors, states, strict=True):
        energy, full = problem.energy.core.value_and_gradient(subspace.basis @ q)
        force = subspace.basis.T @ full
        value, gradient = cubature.value_and_gradient(q)
        target[0] = abs(value - energy) / energy
        target[1] = np.linalg.norm(gradient - force) / np.linalg.norm(force)
        target[2] = np.linalg.norm(compliance @ (gradient - force)) / np.linalg.norm(q)
    median, worst = np.median(errors, axis=0).tolist(), errors.max(axis=0).tolist()
    return CubatureErrors(
        len(states), median[0], worst[0], median[1], worst[1], median[2], worst[2]
    )
