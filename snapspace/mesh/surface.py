"""The surface of a tet mesh: boundary faces and their vertex normals."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IndexArray
from .equal_faces import equal_faces

#: Faces of a positive tet, counter-clockwise seen from outside.
FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


def boundary_faces(tets: IndexArray) -> IndexArray:
    """Faces that belong to exactly one tet, oriented outward.

    Parameters
    ----------
    tets : ndarray of int, (m, 4)
        Positive volumes.

    Returns
    -------
    ndarray of int32, (f, 3)
        In the order of the tets they belong to. Every directed edge of a closed surface occurs as
        often as its reverse.
    """
    faces = tets[:, FACES].reshape(-1, 3)
    order, same = equal_faces(faces)
    differs = np.ones(len(faces) + 1, dtype=np.bool_)
    differs[1:-1] = ~same
    once = differs[:-1] & differs[1:]
    return np.ascontiguousarray(faces[np.sort(order[once])], dtype=np.int32)


def vertex_normals(vertices: FloatArray, faces: IndexArray) -> FloatArray:
    """Unit normals at vertices: the area-weighted mean of the normals of the faces there.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)
        Outward (counter-clockwise).

    Returns
    -------
    ndarray, (n, 3)
        Length 1; zero where a vertex belongs to no face or the face normals cancel.
    """
    corners = vertices[faces]
    # the length of the cross product is twice the area, which is the weight
    weighted = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.stack(
        [
            np.bincount(faces.ravel(), np.repeat(weighted[:, axis], 3), minlength=len(vertices))
            for axis in range(3)
        ],
        axis=1,
    )
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.asarray(np.divide(normals, lengths, out=np.zeros(normals.shape), where=lengths > 0))


def compact_surface(vertices: FloatArray, faces: IndexArray) -> tuple[FloatArray, IndexArray]:
    """Keep only the vertices that faces use, in their order.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)

    Returns
    -------
    vertices : ndarray, (k, 3)
    faces : ndarray of int32, (f, 3)
        The same triangles: `new_vertices[new_faces]` equals `vertices[faces]`.
    """
    used = np.zeros(len(vertices), dtype=np.bool_)
    used[faces] = True
    new_index = np.cumsum(used) - 1
    return vertices[used], np.asarray(new_index[faces], dtype=np.int32)
