"""Stencils for tets of any shape: the part inside the surface, cut into tets.

As `stuffing_stencils`, but the rule for the diagonals is the order of the nodes: on a quadrilateral
with two nodes inside, the diagonal starts at the first of them. It does not need the long edges and
the parity of a lattice.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from snapspace.stuffing.stuffing_stencils import (
    cut_point,
    nodes_by_sign,
    signs_of,
    staircase,
    without_diagonals,
)


@lru_cache(maxsize=1)
def ranked_table() -> tuple[NDArray[np.int64], ...]:
    """Tets of each of the 81 cases of `sign_numbers`, for tets whose nodes ascend.

    As `stencil_table`, but of either orientation.
    """
    stencils = [_stencil(signs_of(number)) for number in range(81)]
    return tuple(np.array(tets, dtype=np.int64).reshape(-1, 4) for tets in stencils)


def _stencil(signs: list[int]) -> list[tuple[int, ...]]:
    inside, zero, outside = nodes_by_sign(signs)
    if (plain := without_diagonals(inside, outside)) is not None:
        return plain
    if len(outside) == 1:
        lines = [(i, cut_point(i, outside[0])) for i in inside]
        return staircase(lines + [(i, i) for i in zero])
    first, second = inside
    lines = [(cut_point(first, o), cut_point(second, o)) for o in outside]
    return staircase([(first, second), *lines])
