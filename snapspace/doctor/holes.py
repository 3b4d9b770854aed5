"""Holes of a surface: connected boundary edges."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..mesh.arrays import IndexArray
from ..mesh.edges import Edges, edges_of
from .cleaned import cleaned
from .minor_parts import minor_parts

FloatArray = NDArray[np.float64]

#: A hole of a larger diameter, as a share of the diagonal, may be intended, as in cloth, a leaf or
#: a mask, which are shells.
WIDEST_FAULT = 0.05


@dataclass(frozen=True, eq=False)
class Hole:
    """Boundary edges that are connected.

    edges : number of edges
    length : their length
    diameter : largest distance along an axis of its bounding box
    flatness : largest distance from the best plane, as a share of the diameter
    center : (3,), mean of the vertices
    vertices : in ascending order
    loop : vertices in the order in which faces run along the edges; None unless they are a simple
        loop
    """

    edges: int
    length: float
    diameter: float
    flatness: float
    center: FloatArray
    vertices: NDArray[np.intp]
    loop: NDArray[np.intp] | None


def holes_of(vertices: FloatArray, edges: Edges) -> list[Hole]:
    """The holes, longest first: edges with one face, connected by their vertices."""
    boundary = edges.uses == 1
    if not boundary.any():
        return []
    face_slot = np.flatnonzero(boundary[edges.of_face.ravel()])
    edge, along = edges.of_face.ravel()[face_slot], edges.along.ravel()[face_slot]
    ends = edges.ends[edge].astype(np.intp)
    directed = np.where(along[:, None], ends, ends[:, ::-1])
    names, local = np.unique(directed, return_inverse=True)
    local = local.reshape(-1, 2)
    graph = coo_array((np.ones(len(local)), (local[:, 0], local[:, 1])), shape=(len(names),) * 2)
    _, label = connected_components(graph, directed=False)
    of_edge = label[local[:, 0]]
    order = np.argsort(of_edge, kind="stable")
    parts = np.split(order, np.flatnonzero(np.diff(of_edge[order])) + 1)
    holes = [_hole(vertices, directed[part]) for part in parts]
    return sorted(holes, key=lambda hole: -hole.length)


def vertices_at(holes: Iterable[Hole]) -> NDArray[np.intp]:
    """The vertices at any of the holes."""
    return np.concatenate([np.empty(0, np.intp), *(hole.vertices for hole in holes)])


def _hole(vertices: FloatArray, directed: NDArray[np.intp]) -> Hole:
    used = np.unique(directed)
    points = vertices[used]
    center = points.mean(axis=0)
    diameter = float(np.ptp(points, axis=0).max())
    steps = vertices[directed[:, 1]] - vertices[directed[:, 0]]
    normal = np.linalg.svd(points - center, full_matrices=False)[2][-1]
    height = float(np.abs((points - center) @ normal).max())
    return Hole(
        edges=len(directed),
        length=float(np.linalg.norm(steps, axis=1).sum()),
        diameter=diameter,
        flatness=height / diameter if diameter > 0 else 0.0,
        center=center,
        vertices=used,
        loop=_loop(directed, used),
    )


def _loop(directed: NDArray[np.intp], used: NDArray[np.intp]) -> NDArray[np.intp] | None:
    follower = dict(directed.tolist())
    if len(follower) != len(directed) or len(used) != len(directed):
        return None
    loop = [int(directed[0, 0])]
    while len(loop) < len(directed):
        after = follower.get(loop[-1])
        if after is None or after == loop[0]:
            return None
        loop.append(after)
    return np.array(loop, np.intp) if follower.get(loop[-1]) == loop[0] else None


def is_sheet(vertices: FloatArray, faces: IndexArray) -> bool:
    """Whether a cleaned surface may be open on purpose, as cloth is."""
    clean = cleaned(vertices, faces).faces
    return len(clean) > 0 and has_wide_hole(vertices, clean)


def has_wide_hole(vertices: FloatArray, faces: IndexArray) -> bool:
    """Whether a surface has a hole that is wider than a fault, not only in minor parts of it."""
    diagonal = float(np.linalg.norm(np.ptp(vertices[faces].reshape(-1, 3), axis=0)))
    holes = holes_of(vertices, edges_of(faces))
    wide = vertices_at(hole for hole in holes if hole.diameter > WIDEST_FAULT * diagonal)
    return wide.size > 0 and not minor_parts(vertices, faces, wide).any()
