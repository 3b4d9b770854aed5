"""Which tets a cubature may choose from."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .elastic_states import ElasticStates

#: States whose forces decide.
PILOTS = 12


def candidate_tets(states: ElasticStates, count: int) -> NDArray[np.int32]:
    """The tets with the largest forces at some of the states: (c,), c <= count, ascending.

    Forces of tets differ by many powers of ten. On the Dragon, d = 120, fits from the largest
    quarter and from all tets have the same errors, and the columns of all need four times the
    memory.
    """
    total = np.zeros(len(states.problem.mesh.tets))
    for state in range(0, len(states), max(1, len(states) // PILOTS)):
        displacement = states.subspace.basis @ states.coordinates[state]
        total += np.linalg.norm(states.forces(state, displacement).stresses, axis=1)
    largest = np.argsort(-total, kind="stable")[:count]
    return np.sort(largest[total[largest] > 0]).astype(np.int32)
