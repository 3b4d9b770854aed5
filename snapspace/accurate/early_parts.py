"""make_early_parts: work of a search that can begin before its first samples are solved."""

from __future__ import annotations

from ..problem import InterpolationProblem, PosingProblem


def make_early_parts(problem: PosingProblem | InterpolationProblem) -> None:
    """Makes what every stage needs besides the system, and what can be made without it."""
    _ = problem.mesh.surface
    if isinstance(problem, PosingProblem):  # otherwise it is the mass of the mean shape, a solution
        problem.mass()
