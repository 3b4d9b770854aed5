"""Linear response modes: responses of the body at rest to affine motions of its handles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array

import snapspace as ss

from .sparse_solver import SparseSolver
from .vibration_modes import hessian_at

FloatArray = NDArray[np.float64]

#: Degrees of freedom of an affine map.
AFFINE = 12


def response_subspace(problem: ss.PosingProblem, dimension: int | None = None) -> ss.AffineSubspace:
    """Linear responses to the twelve affine motions of every handle: up to 12 h dimensions.

    Minimisers of the elastic energy's quadratic form at rest and the handles' energy; each is exact
    for infinitesimal motions. Translations of all handles come first, then linear maps, whose
    antisymmetric parts are rotations.
    """
    directions = linear_responses(problem)
    return ss.affine_subspace(directions[:, :dimension], problem, nested=False)


def linear_responses(problem: ss.PosingProblem) -> FloatArray:
    """Responses (3n, 12 h): translations of each handle, then linear maps of each."""
    mesh, handles = problem.mesh, problem.handles
    masses = mesh.vertex_masses
    pull = np.zeros(len(mesh.vertices))
    translations: list[FloatArray] = []
    linear: list[FloatArray] = []
    for handle, center in zip(handles, problem.centroids, strict=True):
        at = handle.vertices
        weights = 2.0 * problem.stiffness * masses[at]
        pull[at] += weights
        arms = mesh.vertices[at] - center
        for row in range(3):
            for arm, found in ((None, translations), *((a, linear) for a in range(3))):
                load = np.zeros((len(mesh.vertices), 3))
                load[at, row] = weights if arm is None else weights * arms[:, arm]
                found.append(load.ravel())
    rest = hessian_at(problem.energy.core, np.zeros(mesh.vertices.size))
    stiffness = csr_array(rest + diags_array(np.repeat(pull, 3)))
    solver = SparseSolver(stiffness, per_vertex=3)
    return solver.solve(np.array([*translations, *linear]).T)
