"""GradedLattice: a body-centred cubic lattice with smaller cells near given points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from snapspace.stuffing.bcc_lattice import BccLattice
from snapspace.stuffing.halved_tets import (
    MOST_COORDINATE,
    Keys,
    Mask,
    can_fit,
    coordinates_of,
    divided_edges,
    eighths,
    fitted,
    middles,
    node_keys,
)

FloatArray = NDArray[np.float64]
Levels = NDArray[np.intp]

# Tets whose centres are within this distance of a point get smaller, in their cells; and how much
# farther the next larger ones reach, so that neighbours differ by one level at most.
_REACH, _MARGIN = 1.2, 2.0


@dataclass(frozen=True)
class GradedTets:
    """Tets that fill a box and get smaller near points.

    keys : (n,), ascending; equal for the same node in another lattice of the same box
    points : (n, 3), the nodes
    tets : (m, 4), indices of nodes
    irregular : (n,), True for nodes of tets that are not lattice tets
    """

    keys: Keys
    points: FloatArray
    tets: NDArray[np.int64]
    irregular: Mask


class GradedLattice:
    """A lattice whose cells may be halved several times, each time in a smaller part of the box.

    Parameters
    ----------
    lattice : BccLattice
        The largest cells.
    levels : int
        How often cells can be halved.
    wanted : ndarray of bool, (nodes,), default all
        Nodes of the lattice; tets without one of them are left out.

    Raises
    ------
    ValueError
        For more than 2^20 halves of the smallest cells along an axis.

    Attributes
    ----------
    keys : (nodes,)
        Of the nodes of the lattice, in its order.
    """

    def __init__(self, lattice: BccLattice, levels: int, wanted: Mask | None = None) -> None:
        self._cell, self._levels = lattice.cell, levels
        self._unit = lattice.cell / 2.0 / 2**levels
        nodes = np.rint(lattice.points() / (lattice.cell / 2.0)).astype(np.int64)
        self._first = nodes.min(axis=0)
        most = int(np.ptp(nodes, axis=0).max()) << levels
        if most >= MOST_COORDINATE:
            raise ValueError(
                f"GradedLattice: cell is {lattice.cell}, which makes {most} half cells along an "
                f"axis, but at most {MOST_COORDINATE} can be numbered; use a larger cell"
            )
        self.keys = node_keys((nodes - self._first) << levels)
        inner = ~lattice.on_border()
        self._tets = self.keys[lattice.tets_touching(inner if wanted is None else inner & wanted)]

    def tets(self, centers: FloatArray, levels: Levels) -> GradedTets:
        """The tets, where those around each center (c, 3) have been halved `levels` (c,)
        times: conforming, and neighbours differ by one level at most.
        """
        regular, others, whole = [], [], self._tets
        for level in range(int(levels.max(initial=0)) + 1):
            halved = self._near(whole, level, centers, levels)
            halved, divided = _with_misfits(whole, halved)
            left, divided = whole[~halved], divided[~halved]
            fits = ~divided.any(axis=1)
            regular.append(left[fits])
            others.append(fitted(left[~fits], divided[~fits]))
            whole = eighths(whole[halved])
        misfit = np.unique(np.concatenate(others))
        every = np.concatenate([*regular, *others])
        keys, places = np.unique(every, return_inverse=True)
        irregular = np.zeros(len(keys), np.bool_)
        irregular[np.searchsorted(keys, misfit)] = True
        return GradedTets(keys, self._points(keys), places.reshape(every.shape), irregular)

    def _near(self, tets: Keys, level: int, centers: FloatArray, levels: Levels) -> Mask:
        """Which tets of a level have to be halved, (m,)."""
        middle = self._points(tets).mean(axis=1)
        near = np.zeros(len(tets), np.bool_)
        for wanted in range(level + 1, int(levels.max(initial=0)) + 1):
            some = centers[levels == wanted]
            if len(some):
                smaller = [self._cell / 2**between for between in range(level, wanted)]
                reach = _REACH * smaller[-1] + _MARGIN * sum(smaller[:-1])
                distances, _ = cKDTree(some).query(middle, distance_upper_bound=reach)
                near |= np.isfinite(distances)
        return near

    def _points(self, keys: Keys) -> FloatArray:
        corner = self._first << self._levels
        points: FloatArray = (coordinates_of(keys) + corner) * self._unit
        return points


def _with_misfits(tets: Keys, halved: Mask) -> tuple[Mask, Mask]:
    """Which tets to halve so that all others can be fitted, (m,), and divided edges, (m, 6)."""
    while True:
        divided = divided_edges(tets, np.unique(middles(tets[halved])))
        misfits = ~halved & ~can_fit(divided)
        if not misfits.any():
            return halved, divided
        halved = halved | misfits
