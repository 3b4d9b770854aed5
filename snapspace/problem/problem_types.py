"""require_problem, require_posing_problem: refuse anything that is not a problem."""

from __future__ import annotations

from ..arguments import wrong_type
from .posing_problem import PosingProblem


def require_problem(
    problem: object,
    who: str,
    *,
    cure: str = "give a PosingProblem or InterpolationProblem",
) -> None:
    """Raises a ValueError in the name of `who` for anything but a problem, such as a model."""
    if not hasattr(problem, "parameter_count"):  # any class may be a problem
        raise wrong_type(who, "problem", problem, _own_problem(problem) or cure)


def require_posing_problem(problem: object, who: str) -> None:
    """The same, and for a problem without handles."""
    if not isinstance(problem, PosingProblem):
        cure = "give a PosingProblem: only that has handles"
        raise wrong_type(who, "problem", problem, _own_problem(problem) or cure)


def _own_problem(value: object) -> str:
    """The cure for a value that has a problem, such as a model or a session; otherwise empty."""
    if hasattr(value, "problem"):
        return "give its problem, .problem"
    return "give its problem, .model.problem" if hasattr(value, "model") else ""
