"""finite_states: the states of a body at which its energy is finite."""

from __future__ import annotations

import numpy as np

from .elastic_states import States
from .state_forces import state_forces


def finite_states(states: States, fewest: int, *, threads: int | None = None) -> States:
    """The states of finite energy; no cubature can be trained on the others.

    The energy of a material with a barrier is infinite if a tet is inverted. Solutions have no such
    tet, but their projections onto a small subspace may.

    Parameters
    ----------
    states : ElasticStates
        Projected snapshots.
    fewest : int
        Number of states that a cubature needs.
    threads : int, optional
        Default: all.

    Raises
    ------
    ValueError
        If too many of the states have an infinite energy.
    """
    material = states.problem.material
    if not material.barrier:
        return states
    found = state_forces(states.with_forces(), np.zeros(0, np.int32), threads=threads)
    # forces of blends are evaluated twice at each state, with different weights
    finite = np.isfinite(found.energies.reshape(len(states), -1)).all(axis=1)
    if finite.all():
        return states
    if finite.sum() < fewest <= len(states):
        dimension = states.subspace.dimension
        raise ValueError(
            f"reduce: {len(states) - finite.sum()} of {len(states)} snapshots have inverted tets "
            f"once projected onto {dimension} dimensions, where the energy of {material.title} is "
            f"infinite, and a cubature needs {fewest} without; use a larger dimension or more "
            "samples, or a material that allows inverted tets"
        )
    return states.chosen(np.flatnonzero(finite))
