"""Tets ordered by their forces."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from .elastic_states import ElasticStates

#: Number of states whose forces determine the order.
PILOTS = 12


@single_threaded_blas
def tets_by_force(states: ElasticStates, *, threads: int | None = None) -> NDArray[np.int32]:
    """Tets that carry a force at some states, in descending order of force."""
    pilots = range(0, len(states), max(1, len(states) // PILOTS))
    displacements = states.coordinates[pilots] @ states.subspace.basis.T

    def sizes(pilot: int) -> NDArray[np.float64]:
        stresses = states.stresses(pilots[pilot], displacements[pilot])
        norms: NDArray[np.float64] = np.sqrt(np.einsum("te,te->t", stresses, stresses))
        return norms

    with ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool:
        total: NDArray[np.float64] = np.sum([*pool.map(sizes, range(len(pilots)))], axis=0)
    order = np.argsort(-total, kind="stable").astype(np.int32)
    return order[total[order] > 0]
