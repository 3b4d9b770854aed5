"""Points where the surface crosses the edges of the lattice."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from snapspace.stuffing.root_finding import (
    Counter,
    FloatArray,
    ImplicitFunction,
    zero_fractions,
)

# The edges of a tet, by local corners. In stencils the cut point on edge k is number 4 + k.
TET_EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))


@dataclass(frozen=True)
class CutPoints:
    """One crossing on every edge that joins an inside node to an outside node.

    Attributes
    ----------
    inside, outside : ndarray of int64, (k,)
        Nodes of the edges, sorted by inside, then outside; each edge occurs once.
    fractions : ndarray, (k,)
        Position on the edge, from 0 at the inside node to 1 at the outside node.
    points : ndarray, (k, 3)
        Coordinates of the crossings.
    """

    inside: NDArray[np.int64]
    outside: NDArray[np.int64]
    fractions: FloatArray
    points: FloatArray

    def keep(self, mask: NDArray[np.bool_]) -> CutPoints:
        """The cut points selected by a mask (k,)."""
        return CutPoints(
            self.inside[mask], self.outside[mask], self.fractions[mask], self.points[mask]
        )


def find_cut_points(
    implicit: ImplicitFunction,
    points: FloatArray,
    values: FloatArray,
    tets: NDArray[np.int64],
    counter: Counter | None = None,
) -> CutPoints:
    """Locate the surface on all edges of the tets that have ends of opposite sign.

    `counter` counts the steps of `zero_fractions`.
    """
    node_count = np.int64(len(points))
    negative = values < 0.0
    positive = values > 0.0
    keys = []
    for i, j in TET_EDGES:
        a, b = tets[:, i], tets[:, j]
        forward, backward = negative[a] & positive[b], positive[a] & negative[b]
        keys.append(a[forward] * node_count + b[forward])
        keys.append(b[backward] * node_count + a[backward])
    inside, outside = np.divmod(np.unique(np.concatenate(keys)), node_count)
    start, end = points[inside], points[outside]
    fractions = zero_fractions(implicit, start, end, values[inside], values[outside], counter)
    return CutPoints(inside, outside, fractions, start + fractions[:, None] * (end - start))
