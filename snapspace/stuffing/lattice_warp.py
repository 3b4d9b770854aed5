"""Warping: moves lattice nodes that are too close to the surface onto it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from snapspace.stuffing.cut_points import CutPoints
from snapspace.stuffing.root_finding import (
    FloatArray,
    ImplicitFunction,
    evaluate,
    zero_fractions,
)

# A node is too close if a cut point lies within this fraction of its edge. Labelle & Shewchuk
# (2007) chose these values for the best bound on dihedral angles. They warp nodes one by one; here
# all are warped at once, which does not depend on the order (and is not worse in stress tests).
ALPHA_LONG = 0.24999
ALPHA_SHORT = 0.41189


@dataclass(frozen=True)
class CutEdges:
    """The edges that have cut points.

    alphas : (k,), shares of the edge within which its ends are too close to the cut point
    lengths : (k,)
    """

    alphas: FloatArray
    lengths: FloatArray


def lattice_edges(cuts: CutPoints, *, corner_count: int, cell: float) -> CutEdges:
    """The edges of a `BccLattice` with cut points.

    corner_count : number of cell corners; later nodes are cell centres
    cell : length of the long edges, which join two corners or two centres
    """
    is_long = (cuts.inside < corner_count) == (cuts.outside < corner_count)
    return CutEdges(
        np.where(is_long, ALPHA_LONG, ALPHA_SHORT), np.where(is_long, 1.0, np.sqrt(0.75)) * cell
    )


def warp_nodes(
    implicit: ImplicitFunction,
    points: FloatArray,
    values: FloatArray,
    cuts: CutPoints,
    edges: CutEdges,
) -> tuple[FloatArray, NDArray[np.int8], CutPoints]:
    """Move every violated node to its nearest cut point and drop the cut points on its edges.

    If several cut points are exactly equally near, as at nodes on a mirror plane of the shape,
    the node moves to the surface in the direction of their mean. So the warped lattice keeps the
    mirror planes that the shape and the lattice share.

    Parameters
    ----------
    points : ndarray, (nodes, 3)
        Coordinates of the nodes.
    values : ndarray, (nodes,)
        Implicit function at the nodes.
    cuts : CutPoints
        The cut points on all edges with ends of opposite sign.
    edges : CutEdges
        Of the same cuts.

    Returns
    -------
    points : ndarray, (nodes, 3)
        Coordinates after moving.
    signs : ndarray of int8, (nodes,)
        -1 inside, 0 on the surface, 1 outside.
    cuts : CutPoints
        The remaining cut points, on edges where neither node has moved; their distance from both
        nodes is at least alpha times the edge length.
    """
    near_inside = np.flatnonzero(cuts.fractions < edges.alphas)
    near_outside = np.flatnonzero(1.0 - cuts.fractions < edges.alphas)
    cut = np.concatenate([near_inside, near_outside])
    node = np.concatenate([cuts.inside[near_inside], cuts.outside[near_outside]])
    distance = edges.lengths[cut] * np.concatenate(
        [cuts.fractions[near_inside], 1.0 - cuts.fractions[near_outside]]
    )

    order = np.lexsort((cut, distance, node))
    node, cut, distance = node[order], cut[order], distance[order]
    moved, first = np.unique(node, return_index=True)
    owner = np.searchsorted(moved, node)
    tied = distance == distance[first][owner]
    targets = cuts.points[cut[first]]
    several = np.flatnonzero(np.bincount(owner[tied], minlength=len(moved)) > 1)
    if several.size:
        means = _tied_means(cuts.points[cut[tied]], owner[tied], len(moved))[several]
        nodes = moved[several]
        targets[several] = _towards_mean(
            implicit, points[nodes], values[nodes], means, targets[several]
        )

    points = points.copy()
    points[moved] = targets
    signs = np.sign(values).astype(np.int8)
    signs[moved] = 0
    return points, signs, cuts.keep((signs[cuts.inside] != 0) & (signs[cuts.outside] != 0))


def _tied_means(points: FloatArray, owner: NDArray[np.intp], count: int) -> FloatArray:
    """Mean of the points of each owner, (count, 3); every owner has at least one."""
    sums = np.zeros((count, 3))
    np.add.at(sums, owner, points)
    return np.asarray(sums / np.bincount(owner, minlength=count)[:, None])


def _towards_mean(
    implicit: ImplicitFunction,
    nodes: FloatArray,
    values: FloatArray,
    means: FloatArray,
    fallback: FloatArray,
) -> FloatArray:
    """Surface points on the rays from nodes through means; `fallback` where none is near."""
    ends = nodes + 2.0 * (means - nodes)
    end_values = evaluate(implicit, ends)
    found = np.sign(values) * np.sign(end_values) < 0.0
    start, end = nodes[found], ends[found]
    t = zero_fractions(implicit, start, end, values[found], end_values[found])
    targets = fallback.copy()
    targets[found] = start + t[:, None] * (end - start)
    return targets
