"""Soft modes and guesses of bodies with moduli per tet, compared with dense matrices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from snapspace import Material, PosingProblem
from snapspace import _core as core

from .densities import every_kind, varied
from .test_per_tet_moduli import MESH, posing

FloatArray = NDArray[np.float64]


def rest_hessian(problem: PosingProblem) -> FloatArray:
    """The objective's Hessian at rest: the elastic energy's plus twice the handles' weights."""
    held = np.zeros(problem.base.size)
    for axis in range(3):
        held[3 * problem.pinned + axis] = 2.0 * problem.pin_weights
    hessian: FloatArray = problem.energy.hessian(problem.base).toarray() + np.diag(held)
    return hessian


@every_kind
def test_responses_of_the_handles_are_those_of_linear_elasticity(kind: type[Material]) -> None:
    """They agree up to 3 % of the energy, since they are solved to about 1 %.

    Responses for the same moduli in another order are farther off.
    """
    material = varied(kind, len(MESH.tets))
    problem, other = posing(material), posing(material.of_tets(np.arange(len(MESH.tets))[::-1]))
    hessian, elastic = rest_hessian(problem), problem.energy.hessian(problem.base)
    inputs = np.zeros((2, len(problem.pinned), 3))
    inputs[:, -problem.handles[1].vertices.size :] = np.eye(3)[:2, None]  # along x, and along y
    forces = np.zeros((2, len(MESH.vertices), 3))
    forces[:, problem.pinned] = 2.0 * problem.pin_weights[:, None] * inputs
    exact = np.linalg.solve(hessian, forces.reshape(2, -1).T).T

    def gap(system: core.PosingSystem) -> FloatArray:
        small, rows = 1e-4, inputs.reshape(2, -1)
        response = core.LinearResponse(system, rows)
        missed = response.warped(system, small * np.eye(2), small * rows) / small - exact
        left = np.einsum("ij,ij->i", missed @ hessian, missed)
        share: FloatArray = left / np.einsum("ij,ij->i", exact @ elastic, exact)
        return share

    assert (gap(problem.system) < 0.03).all()
    assert (gap(other.system) > 0.06).all()


@every_kind
def test_soft_modes_are_the_lowest_against_the_scalar_matrix(kind: type[Material]) -> None:
    problem = posing(varied(kind, len(MESH.tets)))
    hessian = rest_hessian(problem)
    inverse = np.array([problem.system.precondition(unit) for unit in np.eye(len(hessian))])
    scalar = np.linalg.inv(inverse)
    exact = eigh(hessian, scalar, eigvals_only=True)[:8]
    modes = core.SoftModes(problem.system).modes(problem.system)
    np.testing.assert_allclose(modes @ scalar @ modes.T, np.eye(8), rtol=0, atol=1e-5)
    found = np.sort(np.einsum("ij,ij->i", modes @ hessian, modes))
    # Ritz values bound eigenvalues from above (Courant-Fischer); 1e-3 is for single precision
    assert (found >= exact * (1 - 1e-3)).all()
    assert (found <= 1.1 * exact).all()
