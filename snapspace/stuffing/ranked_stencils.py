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
    staircase,
    without_diagonals,
)


def ranked_numbers(signs: NDArray[np.int8]) -> NDArray[np.int64]:
    """Row of `ranked_table` for tets whose nodes ascend, (m,).

    signs : (m, 4), -1 inside, 0 on the surface, 1 outside
    """
    return np.asarray((signs + 1).astype(np.int64) @ [1, 3, 9, 27])


@lru_cache(maxsize=1)
def ranked_table() -> tuple[NDArray[np.int64], ...]:
    """Tets of each of the 81 cases, as `stencil_table`, but of either orientation."""
    cases = []
    for number in range(81):
        signs = [number // 3**i % 3 - 1 for i in range(4)]
        cases.append(np.array(_stencil(signs), dtype=np.int64).reshape(-1, 4))
    return tuple(cases)


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
