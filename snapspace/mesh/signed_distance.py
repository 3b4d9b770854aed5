"""SignedDistance: distances of points from a closed surface, negative inside."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from .arrays import FloatArray, IndexArray
from .edges import edges_of

_EDGE = 1e-7  # barycentric coordinates below this are on an edge or at a corner


class SignedDistance:
    """Distances from points to a closed surface.

    Parameters
    ----------
    vertices : ndarray, (s, 3)
    faces : ndarray of int, (f, 3)
        Closed and oriented outward. Where faces intersect, signs near them may be wrong: `windings`
        are not.

    Attributes
    ----------
    face_normals, vertex_normals : ndarray, (f, 3) and (s, 3)
        Unit vectors, or zero for faces without area. Those of vertices are weighted by angles.

    Notes
    -----
    The sign is that of the angle-weighted normal at the closest point, which is correct for every
    point: Baerentzen and Aanaes, "Signed Distance Computation Using the Angle Weighted
    Pseudonormal", 2005.
    """

    def __init__(self, vertices: FloatArray, faces: IndexArray) -> None:
        self._faces, self._corners = faces, vertices[faces]
        self._tree = core.FaceTree(vertices, faces)
        self.face_normals = _unit(
            np.cross(
                self._corners[:, 1] - self._corners[:, 0], self._corners[:, 2] - self._corners[:, 0]
            )
        )
        self._edge_normals = _edge_normals(faces, self.face_normals)
        self.vertex_normals = _unit(
            _vertex_normals(len(vertices), faces, self._corners, self.face_normals)
        )

    def __call__(self, points: FloatArray) -> FloatArray:
        """Distances of points (k, 3), as (k,)."""
        face, distances, feet = self._tree.closest(points, np.inf)
        outward = ((points - feet) * self._normals(face, feet)).sum(axis=1) >= 0
        signed: FloatArray = np.where(outward, distances, -distances)
        return signed

    def windings(self, points: FloatArray) -> IndexArray:
        """How often the surface encloses each point (k, 3), as (k,)."""
        return self._tree.windings(points)

    def _normals(self, face: IndexArray, closest: FloatArray) -> FloatArray:
        """Normals (k, 3) of the face, edge or vertex that each closest point is on."""
        on = _barycentric(self._corners[face], closest) > _EDGE
        normals = self.face_normals[face]
        count = on.sum(axis=1)
        for corner in range(3):
            edge = (count == 2) & ~on[:, corner]  # the edge opposite to the corner
            normals[edge] = self._edge_normals[face[edge], corner]
            vertex = (count <= 1) & on[:, corner]
            normals[vertex] = self.vertex_normals[self._faces[face[vertex], corner]]
        return normals


def _barycentric(corners: FloatArray, points: FloatArray) -> FloatArray:
    """Barycentric coordinates (k, 3) of points in the planes of triangles; thirds without area."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    offset = points - corners[:, 0]
    aa, ab, bb, pa, pb = (
        np.einsum("ij,ij->i", x, y)
        for x, y in (
            (first, first),
            (first, second),
            (second, second),
            (offset, first),
            (offset, second),
        )
    )
    area = aa * bb - ab * ab
    scale = np.divide(1.0, area, out=np.zeros_like(area), where=area > 0)
    second_part, third = (bb * pa - ab * pb) * scale, (aa * pb - ab * pa) * scale
    weights = np.stack([1.0 - second_part - third, second_part, third], axis=1)
    weights[~(area > 0)] = 1.0 / 3.0
    return weights


def _edge_normals(faces: IndexArray, face_normals: FloatArray) -> FloatArray:
    """Sums of the normals of the faces at each edge, (f, 3, 3): by face and opposite corner."""
    edge = edges_of(faces).of_face[:, [1, 2, 0]]  # opposite to the corners
    sums = _sums(edge, np.repeat(face_normals[:, None], 3, axis=1), int(edge.max()) + 1)
    normals: FloatArray = sums[edge]
    return normals


def _vertex_normals(
    count: int, faces: IndexArray, corners: FloatArray, face_normals: FloatArray
) -> FloatArray:
    """Normals of the faces around each vertex, weighted by their angles there."""
    weighted = np.empty((3, len(faces), 3))
    for k in range(3):
        first = _unit(corners[:, (k + 1) % 3] - corners[:, k])
        second = _unit(corners[:, (k + 2) % 3] - corners[:, k])
        angle = np.arccos(np.clip(np.einsum("ij,ij->i", first, second), -1.0, 1.0))
        weighted[k] = angle[:, None] * face_normals
    return _sums(faces.T, weighted, count)


def _sums(index: NDArray[np.integer], vectors: FloatArray, count: int) -> FloatArray:
    """Sums of the vectors (..., 3) with each index (...) below `count`, (count, 3)."""
    flat, rows = index.ravel(), vectors.reshape(-1, 3)
    columns = [np.bincount(flat, rows[:, axis], minlength=count) for axis in range(3)]
    return np.stack(columns, axis=1)


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    units: FloatArray = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
    return units
