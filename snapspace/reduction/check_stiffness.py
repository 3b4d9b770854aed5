"""check_stiffness_from: a model that estimates the stiffness must have a cubature of the body."""

from __future__ import annotations

from typing import Any

from ..arguments import wrong_type
from ..cubature import has_stars
from ..problem import InterpolationProblem, PosingProblem
from .posing_model import PosingModel


def check_stiffness_from(
    problem: PosingProblem | InterpolationProblem, energy: str, model: Any
) -> None:
    """Raises ValueError unless `model` has a cubature of the elements of the problem.

    energy : the chosen energy, which must be a cubature as well
    """
    if not isinstance(problem, PosingProblem) or energy != "cubature":
        raise ValueError(
            "reduce: stiffness_from is for cubatures of posing problems; leave it out for blends "
            "and other energies"
        )
    if not isinstance(model, PosingModel):
        raise wrong_type("reduce", "stiffness_from", model, "give a PosingModel, or None")
    if model.problem.mesh.fingerprint != problem.mesh.fingerprint:
        raise ValueError(
            f"reduce: stiffness_from is a model of {model.problem.mesh!r}, but the problem is on "
            f"another mesh, {problem.mesh!r}; give a model of this mesh, or None"
        )
    if model.cubature is None or has_stars(model.problem) != has_stars(problem):
        raise ValueError(
            "reduce: stiffness_from has no cubature of the elements of "
            f"{problem.material.title}; give a model that has one, or None"
        )
