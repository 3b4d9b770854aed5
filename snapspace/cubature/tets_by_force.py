"""Tets in the order of their forces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .elastic_states import ElasticStates

#: States whose forces decide.
PILOTS = 12


def tets_by_force(states: ElasticStates, *, pilots: int = PILOTS) -> NDArray[np.int32]:
    """Tets that carry a force at some `pilots` of the states, the largest forces first."""
    total = np.zeros(len(states.problem.mesh.tets))
    for state in range(0, len(states), max(1, len(states) // pilots)):
        displacement = states.subspace.basis @ states.coordinates[state]
        total += np.linalg.norm(states.forces(state, displacement).stresses, axis=1)
    order = np.argsort(-total, kind="stable").astype(np.int32)
    return order[total[order] > 0]
