"""Which tets a cubature may choose from."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .elastic_states import ElasticStates

#: States whose forces decide.
PILOTS = 12


def candidate_tets(states: ElasticStates, count: int, *, seed: int) -> NDArray[np.int32]:
    """Tets with the largest forces at some of the states, and random others.

    Forces of tets differ by many powers of ten. On the Dragon, d = 120, fits from the largest
    quarter and from all tets have the same errors, and the columns of all need four times the
    memory. Where a few tets are squeezed they would be the only candidates: see
    `BlendingStates.largest_share`.

    Returns
    -------
    (c,) int32, c <= count, ascending
        Of tets that carry a force.
    """
    total = np.zeros(len(states.problem.mesh.tets))
    for state in range(0, len(states), max(1, len(states) // PILOTS)):
        displacement = states.subspace.basis @ states.coordinates[state]
        total += np.linalg.norm(states.forces(state, displacement).stresses, axis=1)
    order = np.argsort(-total, kind="stable")
    order = order[total[order] > 0]
    largest = round(states.largest_share * count)
    others = np.random.default_rng(seed).permutation(order[largest:])
    return np.sort(np.concatenate([order[:largest], others[: count - largest]])).astype(np.int32)
