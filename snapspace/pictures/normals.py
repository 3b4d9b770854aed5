"""Normals for smooth shading that keep the sharp edges of a mesh sharp."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def face_normals(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> NDArray[np.float64]:
    """Unit normals (f, 3); zero for triangles without area."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return _unit(np.cross(b - a, c - a))


def corner_normals(
    vertices: NDArray[np.float64], faces: NDArray[np.int32], *, crease: float = 50.0
) -> NDArray[np.float64]:
    """Unit shading normals (f, 3, 3), one for each corner of each face.

    A corner averages the normals of the faces around its vertex that meet its own face at less
    than `crease` degrees, weighted by their angle at the vertex [Thürmer and Wüthrich 1998]:
    the result does not depend on how a flat region is triangulated, a box keeps its edges and a
    fine organic surface gets its usual vertex normals.
    """
    normals = face_normals(vertices, faces)
    angles = _corner_angles(vertices, faces).ravel()

    # All ordered pairs of corners around a vertex, as runs over the corners sorted by vertex.
    corners = np.argsort(faces.ravel(), kind="stable")
    valence = np.bincount(faces.ravel(), minlength=len(vertices))
    around = valence[faces.ravel()[corners]]
    first = (np.cumsum(valence) - valence)[faces.ravel()[corners]]
    one = np.repeat(np.arange(len(corners)), around)
    other = np.arange(len(one)) - np.repeat(np.cumsum(around) - around - first, around)
    one, other = corners[one], corners[other]

    alignment = np.einsum("ij,ij->i", normals[one // 3], normals[other // 3])
    smooth = alignment > np.cos(np.radians(crease))
    one, other = one[smooth], other[smooth]
    weighted = normals[other // 3] * angles[other, None]
    total: NDArray[np.float64] = np.column_stack(
        [np.bincount(one, weights=axis, minlength=len(corners)) for axis in weighted.T]
    )
    return _unit(total).reshape(-1, 3, 3)


def _corner_angles(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> NDArray[np.float64]:
    points = vertices[faces]
    forward = np.roll(points, -1, axis=1) - points
    backward = np.roll(points, 1, axis=1) - points
    sine = np.linalg.norm(np.cross(forward, backward), axis=2)
    angles: NDArray[np.float64] = np.arctan2(sine, np.einsum("fij,fij->fi", forward, backward))
    return angles


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    result: NDArray[np.float64] = vectors / np.where(length == 0.0, 1.0, length)
    return result
