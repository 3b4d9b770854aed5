"""How far forces move the blends that a cubature is trained on."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..problem import InterpolationProblem
from ..subspace import AffineSubspace
from .blended_cubature import BlendedCubature
from .sampled_tets import sampled_tets

FloatArray = NDArray[np.float64]

#: Tets that stand for all in the Hessian of a state.
SAMPLED = 4000
#: The least eigenvalue of a Hessian, as a share of the least one at the mean shape. Sampling may
#: leave a soft direction without stiffness.
LEAST = 0.1


@single_threaded_blas
def blending_compliances(
    problem: InterpolationProblem,
    subspace: AffineSubspace,
    coordinates: FloatArray,
    weights: FloatArray,
    stiffness: FloatArray,
    ordered: NDArray[np.int32],
    *,
    threads: int | None = None,
) -> FloatArray:
    """Inverse reduced Hessians (s, d, d) at states (s, d) with weights (s, poses).

    What is soft differs from blend to blend: in the Lion's tail by a factor of five along the same
    direction. With the compliance of the mean shape for all blends, cubatures of four poses at d =
    40 leave twice the error. Hessians are estimated from half the tets with the largest forces and
    half random ones.

    Parameters
    ----------
    stiffness : (d, d), the Hessian at the mean shape
    ordered : tets, see `tets_by_force`
    threads : default all; the result is bitwise the same for any number
    """
    sample = sampled_tets(ordered, SAMPLED, seed=0)
    volumes = sample.factors * problem.mesh.volumes[sample.tets]
    least = LEAST * np.linalg.eigvalsh(stiffness)[0]
    result = np.empty((len(coordinates), subspace.dimension, subspace.dimension))
    workers = min(threads or os.cpu_count() or 1, max(len(coordinates), 1))

    def fill(worker: int) -> None:
        # one for each: a cubature keeps the weights that it was asked for last
        estimate = BlendedCubature.of_tets(problem, subspace, sample.tets, volumes)
        for k in range(worker, len(coordinates), workers):
            values, vectors = np.linalg.eigh(estimate.hessian(coordinates[k], weights[k]))
            result[k] = (vectors / np.maximum(values, least)) @ vectors.T

    with ThreadPoolExecutor(max_workers=workers) as pool:
        list(pool.map(fill, range(workers)))
    return result
