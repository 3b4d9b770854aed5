"""How far forces move the states that a cubature is trained on."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from .elastic_states import ElasticStates, PosingStates
from .sampled_tets import sampled_tets

FloatArray = NDArray[np.float64]

#: Tets that stand for all in the Hessian of a state.
SAMPLED = 2000
#: The least eigenvalue of a Hessian, as a share of the least one at tau. Sampling may leave a soft
#: direction without stiffness, and compression may turn its sign.
LEAST = 0.3


@single_threaded_blas
def compliances(
    states: ElasticStates, ordered: NDArray[np.int32], *, threads: int | None = None
) -> FloatArray:
    """Inverse reduced Hessians (s, d, d) of the objective at states.

    What is soft differs from state to state: a bent part turns its soft directions along, and in
    the Lion's tail blends differ by a factor of five along the same direction. With the compliance
    of the rest or the mean shape for all states, cubatures of 500 tets leave the Dragon (d = 120)
    twice the error, and those of four poses of the Lion as well. Hessians are estimated from half
    the tets with the largest forces and half random ones.

    Parameters
    ----------
    states : ElasticStates, s of them
    ordered : tets, see `tets_by_force`
    threads : default all; the result is bitwise the same for any number
    """
    sample = sampled_tets(ordered, SAMPLED, seed=0)
    volumes = sample.factors * states.problem.mesh.volumes[sample.tets]
    result = np.empty((len(states), states.subspace.dimension, states.subspace.dimension))
    workers = min(threads or os.cpu_count() or 1, max(len(states), 1))

    def fill(worker: int) -> None:
        hessian = states.hessians(sample.tets, volumes)
        least = LEAST * np.linalg.eigvalsh(hessian(None))[0]
        for k in range(worker, len(states), workers):
            values, vectors = np.linalg.eigh(hessian(k))
            result[k] = (vectors / np.maximum(values, least)) @ vectors.T

    with ThreadPoolExecutor(max_workers=workers) as pool:
        list(pool.map(fill, range(workers)))
    return result


def judging_compliances(
    states: ElasticStates, ordered: NDArray[np.int32], *, threads: int | None = None
) -> FloatArray:
    """The same for errors to be told: of posing that of the rest shape, for all states.

    Where a state is near buckling its own one is huge, and an error seems so.
    """
    if not isinstance(states, PosingStates):
        return compliances(states, ordered, threads=threads)
    rest = states.rest
    return np.repeat(compliances(rest, ordered, threads=threads), len(states), axis=0)
