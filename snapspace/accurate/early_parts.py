"""make_early_parts: work of a search that can begin before its first samples are solved."""

from __future__ import annotations

from ..problem import InterpolationProblem, PosingProblem


def make_early_parts(problem: PosingProblem | InterpolationProblem) -> None:
    """Makes the parts that every stage needs and that do not need the system."""
    _ = problem.mesh.surface
    if isinstance(problem, PosingProblem):  # a blend's mass is that of its mean shape, a solution
        problem.mass()
