"""The equations that train a cubature: forces and energies of single tets at solutions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..blas import single_threaded_blas
from .elastic_states import ElasticStates
from .state_forces import StateForces, power_of_two

FloatArray = NDArray[np.float64]

#: Weight of the energy of a state, relative to the root mean square of all its force rows together.
#: On the Dragon it reduces the energy's error from 4 % to 0.4 %, and the solutions stay the same.
ENERGY_WEIGHT = 0.5


@dataclass(frozen=True)
class TrainingRows:
    """A linear system for the weights that multiply the tets' volumes.

    columns : (c, k) float32, contributions of the candidate tets, each contiguous
    target : (k,), the sums over all tets of the mesh
    """

    columns: NDArray[np.float32]
    target: FloatArray


@single_threaded_blas
def training_rows(
    states: ElasticStates,
    found: StateForces,
    modes: NDArray[np.float32],
    compliances: FloatArray,
    *,
    directions: int,
    seed: int,
    threads: int | None = None,
) -> TrainingRows:
    """Makes the equations of forces and energies at reduced states.

    These are the equations of energy-conserving sampling and weighting (Farhat, Avery, Chapman,
    Cortial 2014), randomly compressed (Drineas, Mahoney, Muthukrishnan, Sarlos 2011): per state,
    `directions` equations are the tets' reduced forces times the state's compliance times a
    standard normal vector. So a residual is measured as the displacement that the error of the
    forces causes, not as a force: soft directions count most. One more equation per state is the
    energy.

    Parameters
    ----------
    states : ElasticStates
        The s states.
    found : StateForces
        Forces and energies at these states, with the candidates alone.
    modes : (c, e, d) float32
        Displacement gradients of the modes in the c candidate tets, see `Elements.gradients`.
    compliances : (s, d, d)
        Inverse Hessians of the objective at the states.
    directions : int
        Number of force equations per state.
    seed : int
        Seed of the random vectors.
    threads : int, optional
        Default: all. The result is bitwise the same for any number.

    Returns
    -------
    TrainingRows
        A system of s * (directions + 1) equations. With all tets as candidates, weights of one
        would solve it exactly.
    """
    count, d = states.coordinates.shape
    rng = np.random.default_rng(seed)
    along = compliances @ rng.standard_normal((count, d, directions))
    forces = np.einsum("sd,sdk->sk", found.forces, along)
    # exact, since the unit is a power of two: columns fit single precision in any unit of length
    size = power_of_two(np.abs(forces).max(initial=0.0))
    along, forces = along * (found.stress_unit / size), forces / size
    scale = ENERGY_WEIGHT * np.sqrt(np.mean(forces**2) * directions) / found.units
    columns = np.zeros((len(modes), count * (directions + 1)), np.float32)
    core.training_columns(
        modes, found.stresses, along.astype(np.float32), columns, threads=threads or 0
    )
    columns[:, count * directions :] = (found.tet_energies * scale[:, None]).T
    return TrainingRows(columns, np.concatenate([forces.reshape(-1), found.energies * scale]))
