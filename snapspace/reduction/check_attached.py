"""check_attached: a subspace must go through its problem's reference shape."""

from __future__ import annotations

import numpy as np

from ..arguments import wrong_type
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace, check_subspace


def check_attached(
    problem: PosingProblem | InterpolationProblem, subspace: AffineSubspace, *, who: str
) -> None:
    """Raises a ValueError of `who` unless the subspace goes through the problem's tau."""
    if not isinstance(problem, (PosingProblem, InterpolationProblem)):
        raise wrong_type(who, "problem", problem, "give the problem first, then the subspace")
    check_subspace(subspace, who)
    if subspace.tau.shape != problem.base.shape or not np.array_equal(subspace.tau, problem.tau):
        raise ValueError(
            f"{who}: the subspace is not attached to the problem's reference shape: the rest shape "
            "of posing, the mean shape of interpolation"
        )
