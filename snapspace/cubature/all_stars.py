"""Cubatures of all stars, which need no training: the energy is exact."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .blended_stars import BlendedStars
from .cubature import Cubature
from .elements import element_count, elements_of, has_stars

#: Blends use all stars if the usual number is at least this share of them. Frames then take at most
#: twice as long and have no cubature error, and a model of the Centaur is made in 1.1 instead of
#: 6.2 s. Posed surfaces, whose fits are faster, use all stars only if the usual number reaches
#: them.
SHARE = 0.5


def takes_all_stars(
    problem: PosingProblem | InterpolationProblem, wanted: int | None, usual: int
) -> bool:
    """Whether a cubature uses all stars of an as-rigid-as-possible surface.

    wanted : the largest number of stars to choose, or None for the usual number
    """
    if not has_stars(problem):
        return False
    available = element_count(problem)
    if wanted is not None:
        return wanted == available
    share = 1.0 if isinstance(problem, PosingProblem) else SHARE
    return usual >= share * available


def posed_stars(problem: PosingProblem, subspace: AffineSubspace) -> Cubature:
    """The elastic energy of a posed surface in a subspace."""
    return Cubature.of_tets(problem, subspace, *_all_stars(problem))


def blended_stars(problem: InterpolationProblem, subspace: AffineSubspace) -> BlendedStars:
    """The blended energy of a surface in a subspace."""
    return BlendedStars.of_tets(problem, subspace, *_all_stars(problem))


def record_of(cubature: Cubature | BlendedStars, seconds: float) -> dict[str, Any]:
    """For a model's provenance: like the record of a trained cubature, but without errors."""
    return {"tets": len(cubature.tets), "trained_states": 0, "rows": 0, "seconds": seconds}


def _all_stars(
    problem: PosingProblem | InterpolationProblem,
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    measures = elements_of(problem).measures
    return np.arange(len(measures), dtype=np.int32), measures
