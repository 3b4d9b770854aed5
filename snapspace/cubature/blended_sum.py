"""BlendedSum: the blended energy of several poses as a sum over a few elements."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem
from ..subspace import AffineSubspace
from .blended_cubature import BlendedCubature
from .blended_stars import BlendedStars
from .elements import has_stars

BlendedSum = BlendedCubature | BlendedStars


def blended_sum(
    problem: InterpolationProblem,
    subspace: AffineSubspace,
    tets: NDArray[np.int32],
    weights: NDArray[np.float64],
) -> BlendedSum:
    """The sum over some elements of a problem, for a subspace attached to its mean shape.

    See `BlendedCubature.of_tets` and `BlendedStars.of_tets`.
    """
    kind = BlendedStars if has_stars(problem) else BlendedCubature
    return kind.of_tets(problem, subspace, tets, weights)
