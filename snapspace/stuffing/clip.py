"""clip_tets: the parts of tets inside a surface, by a table of stencils."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from snapspace.stuffing.cut_points import TET_EDGES, CutPoints


def clip_tets(
    tets: NDArray[np.int64],
    signs: NDArray[np.int8],
    numbers: NDArray[np.int64],
    table: Sequence[NDArray[np.int64]],
    cuts: CutPoints,
) -> NDArray[np.int64]:
    """The parts of tets inside the surface; cut point c becomes vertex ``len(signs) + c``.

    Parameters
    ----------
    tets : ndarray of int64, (m, 4)
    signs : ndarray of int8, (nodes,)
        -1 inside, 0 on the surface, 1 outside.
    numbers : ndarray of int64, (m,)
        The row of the table for each tet, `case_numbers` or `sign_numbers`.
    table : sequence of ndarray
        `stencil_table` or `ranked_table`.
    cuts : CutPoints
        The cut points on all edges from -1 to 1.

    Returns
    -------
    ndarray of int64, (k, 4)
        The tets of the stencils.
    """
    cut_keys = cuts.inside * len(signs) + cuts.outside
    pieces = []
    for number in np.unique(numbers):
        stencil = table[number]
        chosen = tets[numbers == number]
        local = np.zeros((len(chosen), 10), dtype=np.int64)
        local[:, :4] = chosen
        for point in np.unique(stencil[stencil >= 4]):
            i, j = TET_EDGES[point - 4]
            if signs[chosen[0, i]] > 0:
                i, j = j, i
            keys = chosen[:, i] * len(signs) + chosen[:, j]
            local[:, point] = len(signs) + np.searchsorted(cut_keys, keys)
        pieces.append(local[:, stencil].reshape(-1, 4))
    return np.concatenate(pieces)
