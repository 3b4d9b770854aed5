"""Coarser tet meshes of the same body, by edge collapses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import snapspace as ss

from .collapse_tests import common_neighbours, fits
from .surface_quadrics import squared_distances, surface_quadrics
from .tet_edges import TetEdges, adjacency, tets_of_vertices

FloatArray = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Squared distances from the surface count this many times as much as squared lengths.
SURFACE = 10.0
#: Collapses that are tested together, as a share of all vertices; at least the second number.
TRIED, LEAST_TRIED = 0.5, 2000
#: An interior collapse removes about this many tets.
REMOVED = 6


@dataclass(frozen=True, eq=False)
class CoarseMesh:
    """A mesh whose vertices are some of a finer one's, so that it carries the same modes.

    kept : (k,) vertices of the finer mesh, ascending
    mesh : TetMesh of these
    """

    kept: Integers
    mesh: ss.TetMesh


def coarse_meshes(
    mesh: ss.TetMesh, sizes: Sequence[int], *, poses: FloatArray | None = None
) -> Iterator[CoarseMesh]:
    """Meshes with at most these numbers of tets, descending; the same for the same input.

    A collapse removes a vertex and pulls its tets to a neighbour. It is done where no tet inverts
    or becomes a sliver, where the topology stays, and on the surface only along it. Short edges
    whose end is near the planes of the surface around the removed vertex come first. Collapses of
    a round do not touch each other.

    poses : (p, n, 3), further shapes in which no tet may invert

    Raises
    ------
    ValueError
        If no further edge can be collapsed.
    """
    tets: Integers = mesh.tets.astype(np.int64)
    quadrics = surface_quadrics(mesh)
    rest = mesh.vertices[None]
    shapes = rest if poses is None else np.concatenate([rest, poses])
    for size in sizes:
        while len(tets) > size:
            smaller = _round(shapes, tets, quadrics, size)
            if len(smaller) == len(tets):
                raise ValueError(f"coarse_meshes: no edge of {len(tets)} tets can be collapsed")
            tets = smaller
        kept, flat = np.unique(tets, return_inverse=True)
        small = flat.reshape(-1, 4).astype(np.int32)
        yield CoarseMesh(kept, ss.TetMesh(mesh.vertices[kept], small))


def _round(shapes: FloatArray, tets: Integers, quadrics: FloatArray, size: int) -> Integers:
    """The tets after independent collapses, until there are about `size` of them."""
    count = shapes.shape[1]
    edges = TetEdges.of_mesh(tets, count)
    ends = np.concatenate([edges.ends, edges.ends[:, ::-1]])  # from the removed vertex
    along = np.tile(edges.on_surface, 2)
    links = np.tile(edges.link_sizes(), 2)
    may = np.flatnonzero(along | ~edges.surface_vertices[ends[:, 0]])
    removed, kept = shapes[0][ends[may].T]
    away = squared_distances(quadrics[ends[may, 0]], kept)
    costs = ((removed - kept) ** 2).sum(axis=1) + SURFACE * away
    order = may[np.argsort(costs, kind="stable")]
    tried = max(int(TRIED * len(np.unique(tets))), LEAST_TRIED)
    rims = edges.ends[edges.on_surface]
    incident = tets_of_vertices(tets, count)
    for begin in range(0, len(order), tried):
        chosen = order[begin : begin + tried]
        pairs = ends[chosen]
        same = common_neighbours(edges.ends, pairs, count) == links[chosen]
        flat = common_neighbours(rims, pairs, count) == 2
        pairs = pairs[same & (flat | ~along[chosen])]
        for shape in shapes:
            pairs = pairs[fits(shape, tets, incident, pairs)]
        if len(pairs):
            most = 1 + (len(tets) - size) // REMOVED
            return _collapsed(tets, edges, quadrics, pairs, most=most)
    return tets


def _collapsed(
    tets: Integers, edges: TetEdges, quadrics: FloatArray, pairs: Integers, *, most: int
) -> Integers:
    """The tets after the first `most` collapses of the list that do not touch each other."""
    count = len(edges.surface_vertices)
    neighbours = adjacency(edges.ends, count)
    locked, target = np.zeros(count, bool), np.arange(count)
    for removed, kept in pairs:
        if locked[removed] or locked[kept]:
            continue
        near = slice(neighbours.indptr[removed], neighbours.indptr[removed + 1])
        locked[neighbours.indices[near]] = True
        locked[removed] = True
        target[removed] = kept
        quadrics[kept] += quadrics[removed]
        most -= 1
        if not most:
            break
    moved = target[tets]
    ordered = np.sort(moved, axis=1)
    remaining: Integers = moved[(ordered[:, 1:] != ordered[:, :-1]).all(axis=1)]
    return remaining
