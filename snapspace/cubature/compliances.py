"""Compliances: how far forces move the states that a cubature is trained on."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from copy import copy

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from .blended_sum import BlendedSum
from .cubature import Cubature
from .elastic_states import ElasticStates, PosingStates
from .elements import elements_of
from .sampled_tets import sampled_tets

FloatArray = NDArray[np.float64]

#: Number of tets of the first estimate of Hessians.
SAMPLED = 1000
#: Lower bound of a Hessian's eigenvalues, as a share of the smallest one at tau. Sampling may leave
#: a soft direction without stiffness, and compression may make its stiffness negative.
LEAST = 0.3


def sampled_energy(states: ElasticStates, ordered: NDArray[np.int32]) -> Cubature | BlendedSum:
    """The energy summed over a sample of tets: half of them are those with the largest forces.

    Along a soft direction the contributions of tets cancel, and a sample may be far off: at one
    state of a dog with handles at its tips, six eigenvalues are below the bound `LEAST`; with all
    tets none is. A fit whose force errors are measured by this energy is close to all tets.

    ordered : (m,) tets in the order of `tets_by_force`
    """
    sample = sampled_tets(ordered, SAMPLED, seed=0)
    volumes = sample.factors * elements_of(states.problem).measures[sample.tets]
    return states.sum_over(sample.tets, volumes)


@single_threaded_blas
def compliances(
    states: ElasticStates, estimate: Cubature | BlendedSum, *, threads: int | None = None
) -> FloatArray:
    """Inverse reduced Hessians (s, d, d) of the objective at states.

    Soft directions differ from state to state: they turn with a part that bends, and along one
    direction of the Lion's tail the stiffness of blends differs by a factor of five. With the
    compliance of the rest or the mean shape for all states, cubatures of 500 tets have twice the
    error on the Dragon (d = 120), and on four poses of the Lion.

    Parameters
    ----------
    states : ElasticStates
        The s states.
    estimate : Cubature, BlendedCubature or BlendedStars
        Estimates Hessians: `sampled_energy`, or a fit.
    threads : int, optional
        Default: all. The result is bitwise the same for any number.
    """
    result = np.empty((len(states), states.subspace.dimension, states.subspace.dimension))
    workers = min(threads or os.cpu_count() or 1, max(len(states), 1))

    def fill(worker: int) -> None:
        hessian = states.hessians(copy(estimate))  # one thread may use it at a time
        with np.errstate(over="ignore", invalid="ignore"):
            rest = hessian(None)
        if not np.isfinite(rest).all():
            raise ValueError(
                "reduce: the energies of tets leave single precision, 1e-38 to 1e38; use units in "
                "which the body's size and its moduli are nearer to 1"
            )
        least = LEAST * np.linalg.eigvalsh(rest)[0]
        for k in range(worker, len(states), workers):
            values, vectors = np.linalg.eigh(hessian(k))
            result[k] = (vectors / np.maximum(values, least)) @ vectors.T

    with ThreadPoolExecutor(max_workers=workers) as pool:
        list(pool.map(fill, range(workers)))
    return result


def judging_compliances(
    states: ElasticStates, estimate: Cubature | BlendedSum, *, threads: int | None = None
) -> FloatArray:
    """Compliances (s, d, d) for error reports: for posing, that of the rest shape for all states.

    Near buckling a state's own compliance is huge, and would make its error look huge.
    """
    if not isinstance(states, PosingStates):
        return compliances(states, estimate, threads=threads)
    rest = states.rest
    return np.repeat(compliances(rest, estimate, threads=threads), len(states), axis=0)
