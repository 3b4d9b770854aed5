"""GradedStuffing: tets inside an implicit surface, smaller where parts are thin."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from snapspace.mesh.quality import turned_right
from snapspace.stuffing.clip import clip_tets
from snapspace.stuffing.cut_points import CutPoints, find_cut_points
from snapspace.stuffing.graded_lattice import GradedLattice, GradedTets, Levels
from snapspace.stuffing.halved_tets import coordinates_of
from snapspace.stuffing.isosurface_stuffing import Progress, lattice_in
from snapspace.stuffing.largest_component import largest_component
from snapspace.stuffing.lattice_warp import ALPHA_LONG, ALPHA_SHORT, CutEdges, warp_nodes
from snapspace.stuffing.ranked_stencils import ranked_table
from snapspace.stuffing.root_finding import FloatArray, ImplicitFunction, evaluate
from snapspace.stuffing.stuffing_stencils import sign_numbers


class GradedStuffing:
    """Isosurface stuffing with cells that may be halved near some points.

    As `stuff`, but diagonals follow the order of the nodes, and angles have no bound: the smallest
    dihedral angles of eight surfaces are 6 to 14 degrees, and those of one tet in a hundred 19 to
    22. The signed distance of a node is computed once for all calls.

    Parameters
    ----------
    implicit : callable, (k, 3) -> (k,)
        A signed distance, negative inside.
    lower, upper, cell : as for `stuff`
        `cell` is that of the largest cells.
    levels : int
        How often cells may be halved.
    progress : as for `stuff`

    Raises
    ------
    ValueError
        As for `stuff`, and for more cells along an axis than `GradedLattice` can number.
    """

    def __init__(
        self,
        implicit: ImplicitFunction,
        lower: FloatArray,
        upper: FloatArray,
        cell: float,
        *,
        levels: int,
        progress: Progress | None = None,
    ) -> None:
        self._implicit, self._progress = implicit, progress
        lattice = lattice_in(lower, upper, cell)
        values = evaluate(implicit, lattice.points(), self._counter("inside"))
        # edges are at most as long as a cell: no tet with a part inside has a node farther outside
        self._lattice = GradedLattice(lattice, levels, values < cell)
        order = np.argsort(self._lattice.keys)
        self._known = self._lattice.keys[order], values[order]

    def tets(self, centers: FloatArray, levels: Levels) -> tuple[FloatArray, NDArray[np.int32]]:
        """The largest component of the tets inside, with cells halved `levels` (c,) times near
        centers (c, 3). Its boundary may touch itself. Without a node inside there are none.
        """
        grid = self._lattice.tets(centers, levels)
        values = self._values(grid)
        if not (values < 0.0).any():
            return np.zeros((0, 3)), np.zeros((0, 4), np.int32)
        tets = grid.tets[(values < 0.0)[grid.tets].any(axis=1)]
        cuts = find_cut_points(self._implicit, grid.points, values, tets, self._counter("boundary"))
        points, signs, cuts = warp_nodes(
            self._implicit, grid.points, values, cuts, _cut_edges(grid, cuts)
        )
        tets = np.sort(tets, axis=1)
        clipped = clip_tets(tets, signs, sign_numbers(signs[tets]), ranked_table(), cuts)
        vertices, inside = largest_component(np.concatenate([points, cuts.points]), clipped)
        return vertices, turned_right(vertices, inside)

    def _values(self, grid: GradedTets) -> FloatArray:
        """The implicit function at the nodes."""
        keys, known = self._known
        place = np.minimum(np.searchsorted(keys, grid.keys), len(keys) - 1)
        is_known = keys[place] == grid.keys
        values = np.empty(len(grid.keys))
        values[is_known] = known[place[is_known]]
        new = grid.points[~is_known]
        values[~is_known] = evaluate(self._implicit, new, self._counter("inside"))
        self._known = grid.keys, values
        return values

    def _counter(self, part: str) -> partial[None] | None:
        return None if self._progress is None else partial(self._progress, part)


def _cut_edges(grid: GradedTets, cuts: CutPoints) -> CutEdges:
    """Long edges of lattice tets are parallel to an axis; short ones are diagonals of cells."""
    ends = coordinates_of(grid.keys[cuts.outside]) - coordinates_of(grid.keys[cuts.inside])
    is_long = (ends != 0).sum(axis=1) == 1
    irregular = grid.irregular[cuts.inside] | grid.irregular[cuts.outside]
    alphas = np.where(is_long | irregular, ALPHA_LONG, ALPHA_SHORT)
    lengths = np.linalg.norm(grid.points[cuts.outside] - grid.points[cuts.inside], axis=1)
    return CutEdges(alphas, lengths)
