"""What the stars of a surface that is as rigid as possible leave of its energy, in a file.

It depends on all vertices. With it, readers need the stars of few vertices only, as the page does.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..energy import VertexStars
from ..material import Material
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import BlendedStars, BlendedSum, Cubature
from .container import Arrays

#: Of a posing model, (d, d); of an interpolation, (poses, d + 1, d + 1).
REMAINDER, FORMS = "stars_remainder", "stars_forms"
#: `BlendedStars.dirichlet_forms`, for readers that have no time for them: (poses, d, d).
DIRICHLET = "stars_dirichlet"


#: The triangles of the chosen stars, see `StarTriangles`; none if each is one ring of a vertex.
STARTS, TRIANGLES, SHARES = "stars_starts", "stars_triangles", "stars_shares"


def remainder_arrays(elastic: Cubature, problem: PosingProblem) -> Arrays:
    """The arrays of a posing model whose elements are stars; none for others."""
    stars = problem.energy.stars
    if elastic.remainder is None or stars is None:
        return {}
    return {REMAINDER: elastic.remainder, **_star_arrays(problem.material, stars, elastic.tets)}


def form_arrays(blends: BlendedSum, problem: InterpolationProblem) -> Arrays:
    """The arrays of an interpolation whose elements are stars; none for others."""
    stars = problem.pose_energies.stars
    if not isinstance(blends, BlendedStars) or stars is None:
        return {}
    own = _star_arrays(problem.material, stars[0], blends.tets)
    return {FORMS: blends.forms, DIRICHLET: blends.dirichlet_forms, **own}


def check_stars(
    arrays: Arrays, material: Material, stars: VertexStars, tets: NDArray[np.int32]
) -> None:
    """ValueError unless a file has the triangles that a problem's stars have.

    Files from before stars had a radius have none.
    """
    for name, own in _star_arrays(material, stars, tets).items():
        if not np.array_equal(arrays[name], own):
            raise ValueError(f"{name} is not that of the surface")


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of these arrays, if there are any."""
    doubles = {name: np.float64 for name in (REMAINDER, FORMS, DIRICHLET, SHARES)}
    indices = {name: np.int32 for name in (STARTS, TRIANGLES)}
    return {name: kind for name, kind in (doubles | indices).items() if name in arrays}


def _star_arrays(material: Material, stars: VertexStars, tets: NDArray[np.int32]) -> Arrays:
    if not material.settings.get("radius"):
        return {}
    own = stars.triangles(tets)
    return {STARTS: own.starts, TRIANGLES: own.triangles, SHARES: own.shares}
