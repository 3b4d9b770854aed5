"""Forces and energies at many states, of all tets together and of some tets alone."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..blas import single_threaded_blas
from .elastic_states import ElasticStates

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class StateForces:
    """Energies and forces at s states, and the contributions of some tets.

    energies : (s,), of all tets together
    units : (s,), energies that errors are relative to
    forces : (s, d), reduced gradients of the energies
    stresses : (s, c, 9) float32, first Piola-Kirchhoff stress times volume of some tets; blended
        stars have nine numbers for each pose
    stress_unit : unit of these numbers, a power of two near the mean stiffness times volume
    tet_energies : (s, c), energies of the same tets
    """

    energies: FloatArray
    units: FloatArray
    forces: FloatArray
    stresses: NDArray[np.float32]
    stress_unit: float
    tet_energies: FloatArray


def power_of_two(size: float) -> float:
    """The power of two above a size, or 1 for zero."""
    return float(np.ldexp(1.0, np.frexp(size)[1]))


@single_threaded_blas
def state_forces(
    states: ElasticStates, tets: NDArray[np.int32], *, threads: int | None = None
) -> StateForces:
    """Evaluates all states, and the tets (c,) alone; bitwise the same for any `threads`."""
    basis, count = states.subspace.basis, len(states)
    energies, forces = np.empty(count), np.empty((count, basis.shape[1]))
    stresses: list[NDArray[np.float32]] = [np.empty(0, np.float32)] * -(-count // core.lane_count)
    tet_energies = np.empty((count, len(tets)))
    body, material = states.problem.mesh, states.problem.material
    unit = power_of_two(float(np.mean(material.stiffness)) * body.diagonal**3 / len(body.elements))

    def fill(first: int) -> None:
        some = slice(first, min(first + core.lane_count, count))
        displacements = states.coordinates[some] @ basis.T
        found = states.evaluated(first, displacements, tets)
        energies[some], forces[some] = found.energies, found.gradients @ basis
        if len(tets):
            stresses[first // core.lane_count] = (found.stresses / unit).astype(np.float32)
            tet_energies[some] = found.tet_energies

    with ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool:
        list(pool.map(fill, range(0, count, core.lane_count)))
    units = np.maximum(energies, states.floor)
    every = np.concatenate(stresses) if len(tets) else np.empty((count, 0, 9), np.float32)
    return StateForces(energies, units, forces, every, unit, tet_energies)
