"""check_attached: a subspace has to go through a problem's reference shape."""

from __future__ import annotations

import numpy as np

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace


def check_attached(
    problem: PosingProblem | InterpolationProblem, subspace: AffineSubspace, *, who: str
) -> None:
    """ValueError of `who` unless the subspace goes through the problem's tau."""
    if subspace.tau.shape != problem.base.shape or not np.array_equal(subspace.tau, problem.tau):
        raise ValueError(
            f"{who}: the subspace is not attached to the problem's reference shape: the rest shape "
            "of posing, the mean shape of interpolation"
        )
