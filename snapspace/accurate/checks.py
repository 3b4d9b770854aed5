"""Checks of the target, the budget and the number of samples that a caller asks for."""

from __future__ import annotations

from collections.abc import Callable

from ..arguments import check_target, is_finite, is_whole, shown
from ..input_error import located
from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction.shown_surface import surface_in
from ..snapshots import Checkpoint, SolverOptions, check_solving
from .search_options import SearchOptions

#: Smallest number of samples, and of held-out ones among them.
FEWEST_SAMPLES, FEWEST_HELD_OUT = 20, 4


def check_problem(problem: object, who: str) -> None:
    """Raises a ValueError in the name of `who` for anything but a problem, such as a mesh."""
    if not isinstance(problem, (PosingProblem, InterpolationProblem)):
        raise ValueError(
            f"{who}: got a {type(problem).__name__}, but needs a problem, such as "
            "PosingProblem(mesh, handles, domain=box) or InterpolationProblem(poses)"
        )


def check_search(
    problem: PosingProblem | InterpolationProblem,
    limits: SearchOptions,
    options: SolverOptions | None,
    surface: EmbeddedSurface | None,
    who: str,
    *,
    checkpoint: Checkpoint | None = None,
    **functions: Callable[[str], None] | None,
) -> None:
    """Raises a ValueError in the name of `who` before samples are solved in vain.

    functions : arguments that must be functions or None, by name
    """
    check_problem(problem, who)
    with located(who):
        _check_limits(limits)
    check_solving(who, options, checkpoint, **functions)
    if surface is not None:
        surface_in(problem.mesh, surface, who=who)


def _check_limits(limits: SearchOptions) -> None:
    if limits.target_error is not None:
        check_target(limits.target_error)
    if limits.most_samples is not None:
        check_most(limits.most_samples)
    check_budget(limits.budget)


def check_budget(budget: float | None) -> None:
    """Raises ValueError unless a budget in seconds is positive and finite, or None."""
    if budget is not None and not (is_finite(budget) and budget > 0):
        raise ValueError(
            f"the budget is {shown(budget)} seconds, but it must be positive and finite"
        )


def check_most(most_samples: int) -> None:
    """Raises ValueError for too few samples."""
    if not is_whole(most_samples) or most_samples < FEWEST_SAMPLES:
        raise ValueError(
            f"most_samples is {shown(most_samples)}, but at least {FEWEST_SAMPLES} are "
            "needed to train on some and judge by others"
        )
