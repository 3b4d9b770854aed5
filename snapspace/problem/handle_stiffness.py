"""The default stiffness of handles, and how far solutions miss them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..arguments import is_finite, is_number, wrong_type
from ..material import Material
from ..mesh import Body

if TYPE_CHECKING:
    from .posing_problem import PosingProblem

FloatArray = NDArray[np.float64]

#: In units of the shear modulus over the squared diagonal. Handles then miss their targets by about
#: a ten-thousandth of the diagonal. Problems made by hand have 1.6e5 to 4e5.
RELATIVE_STIFFNESS = 2e5


def checked_stiffness(stiffness: float) -> float:
    """The weight of the handles as a float; ValueError unless it is positive and finite."""
    if not is_number(stiffness):
        raise wrong_type("PosingProblem", "stiffness", stiffness, "give a positive number")
    if not (is_finite(stiffness) and stiffness > 0):
        raise ValueError(f"PosingProblem: stiffness is {stiffness}, but it must be positive")
    return float(stiffness)


def usual_stiffness(mesh: Body, material: Material) -> float:
    """The default stiffness of handles: 2e5 times the mean shear modulus over the squared diagonal.

    Solutions keep their form if mesh and motions are scaled together, or if all moduli are scaled.
    """
    mu = np.broadcast_to(material.mu, len(mesh.cells))
    return RELATIVE_STIFFNESS * float(np.average(mu, weights=mesh.volumes)) / mesh.diagonal**2


def handle_misses(
    problem: PosingProblem, parameters: FloatArray, displacements: Iterable[FloatArray]
) -> FloatArray:
    """How far solutions miss the targets of their handles, as shares of the motions, (k,).

    Root mean squares over the vertices of all handles, weighted by mass; zero where nothing moves.

    Parameters
    ----------
    problem : PosingProblem
    parameters : (k, p)
    displacements : k displacements (3n,) from rest
    """
    masses = problem.mesh.vertex_masses[problem.pinned]
    misses = []
    for wanted, row in zip(problem.inputs(parameters), displacements, strict=True):
        asked = wanted.reshape(-1, 3)
        away = row.reshape(-1, 3)[problem.pinned] - asked
        motion = float(masses @ (asked**2).sum(axis=1))
        missed = float(masses @ (away**2).sum(axis=1))
        misses.append(np.sqrt(missed / motion) if motion > 0 else 0.0)
    return np.array(misses)
