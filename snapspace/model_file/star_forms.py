"""What the stars of a surface that is as rigid as possible leave of its energy, in a file.

It depends on all vertices. With it, readers need the stars of few vertices only, as the page does.
"""

from __future__ import annotations

import numpy as np

from ..reduction import BlendedStars, BlendedSum, Cubature
from .container import Arrays

#: Of a posing model, (d, d); of an interpolation, (poses, d + 1, d + 1).
REMAINDER, FORMS = "stars_remainder", "stars_forms"
#: `BlendedStars.dirichlet_forms`, for readers that have no time for them: (poses, d, d).
DIRICHLET = "stars_dirichlet"


def remainder_arrays(elastic: Cubature) -> Arrays:
    """The array of a posing model whose elements are stars; none for others."""
    return {} if elastic.remainder is None else {REMAINDER: elastic.remainder}


def form_arrays(blends: BlendedSum) -> Arrays:
    """The arrays of an interpolation whose elements are stars; none for others."""
    if not isinstance(blends, BlendedStars):
        return {}
    return {FORMS: blends.forms, DIRICHLET: blends.dirichlet_forms}


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of these arrays, if there are any."""
    return {name: np.float64 for name in (REMAINDER, FORMS, DIRICHLET) if name in arrays}
