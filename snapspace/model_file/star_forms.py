"""The energy of an as-rigid-as-possible surface that is not in its stars, in a file.

It depends on all vertices. With it, readers such as the page need the stars of only a few vertices.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..certificate import ErrorEstimator, stars_of
from ..energy import VertexStars
from ..material import Material
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import BlendedStars, BlendedSum, Cubature
from .container import Arrays

#: The form of a posing model, (d, d), or of an interpolation, (poses, d + 1, d + 1).
REMAINDER, FORMS = "stars_remainder", "stars_forms"
#: `BlendedStars.dirichlet_forms`, for readers that have no time to compute them: (poses, d, d).
DIRICHLET = "stars_dirichlet"


#: The triangles of the chosen stars, see `StarTriangles`; none for one-rings.
CHOSEN = "stars"
#: The same of the stars around the vertices where residuals are read.
SAMPLED = "estimator_stars"


def remainder_arrays(elastic: Cubature, problem: PosingProblem) -> Arrays:
    """The arrays of a posing model whose elements are stars; none for others."""
    stars = problem.energy.stars
    if elastic.remainder is None or stars is None:
        return {}
    return {
        REMAINDER: elastic.remainder,
        **_star_arrays(CHOSEN, problem.material, stars, elastic.tets),
    }


def form_arrays(blends: BlendedSum, problem: InterpolationProblem) -> Arrays:
    """The arrays of an interpolation whose elements are stars; none for others."""
    stars = problem.pose_energies.stars
    if not isinstance(blends, BlendedStars) or stars is None:
        return {}
    own = _star_arrays(CHOSEN, problem.material, stars[0], blends.tets)
    return {FORMS: blends.forms, DIRICHLET: blends.dirichlet_forms, **own}


def sampled_arrays(
    problem: PosingProblem | InterpolationProblem, estimator: ErrorEstimator | None
) -> Arrays:
    """The stars around the sampled vertices of an estimator; none for one-rings."""
    if estimator is None or not problem.material.settings.get("radius"):
        return {}
    stars = stars_of(problem)[0]
    around = np.unique(stars.parts(np.unique(estimator.sample.vertices)).stars)
    return _star_arrays(SAMPLED, problem.material, stars, around)


def check_sampled_stars(
    arrays: Arrays,
    problem: PosingProblem | InterpolationProblem,
    estimator: ErrorEstimator | None,
) -> None:
    """ValueError unless a file has the triangles that the stars around the samples have."""
    _check(arrays, sampled_arrays(problem, estimator))


def check_stars(
    arrays: Arrays, material: Material, stars: VertexStars, tets: NDArray[np.int32]
) -> None:
    """ValueError unless a file has the triangles that a problem's stars have.

    Files from before stars had a radius have none.
    """
    _check(arrays, _star_arrays(CHOSEN, material, stars, tets))


def _check(arrays: Arrays, own: Arrays) -> None:
    for name, array in own.items():
        if name not in arrays:
            raise ValueError(f"{name} is missing")
        if not np.array_equal(arrays[name], array):
            raise ValueError(f"{name} is not that of the surface")


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of these arrays, if there are any."""
    kinds: dict[str, type] = {name: np.float64 for name in (REMAINDER, FORMS, DIRICHLET)}
    for name in (CHOSEN, SAMPLED):
        kinds |= {f"{name}_starts": np.int32, f"{name}_triangles": np.int32}
        kinds[f"{name}_shares"] = np.float64
    return {name: kind for name, kind in kinds.items() if name in arrays}


def _star_arrays(
    name: str, material: Material, stars: VertexStars, which: NDArray[np.int32]
) -> Arrays:
    if not material.settings.get("radius"):
        return {}
    own = stars.triangles(which)
    return {
        f"{name}_starts": own.starts,
        f"{name}_triangles": own.triangles,
        f"{name}_shares": own.shares,
    }
