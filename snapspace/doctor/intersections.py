"""Faces of a surface that cross each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.box_tree import BoxTree
from ..stopping import check_stop

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]
Pairs = NDArray[np.intp]

_BLOCK = 200_000  # pairs of faces at a time
# Volumes below this share of the cube of the longest side are zero up to rounding.
_ROUNDING = 1e-12
_EDGES = ((0, 1), (1, 2), (2, 0))


def crossing_faces(vertices: FloatArray, faces: IndexArray) -> Pairs:
    """Pairs of faces that cross: an edge of one passes through the interior of the other.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)

    Returns
    -------
    ndarray of int, (k, 2)
        Faces that only touch, or lie on each other in a plane, are left out.
    """
    corners = vertices[faces]
    tree = BoxTree(corners.min(axis=1), corners.max(axis=1))
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.ptp(corners, axis=1).max(axis=1)
    found = [np.empty((0, 2), np.intp)]
    for first, second in tree.overlapping():
        check_stop()
        for start in range(0, len(first), _BLOCK):
            one, other = first[start : start + _BLOCK], second[start : start + _BLOCK]
            for _ in range(2):  # most pairs end here
                cut = _cut_by_plane(corners, normals, size, one, other)
                one, other = other[cut], one[cut]
            found.append(_crossing(corners, faces, size, one, other))
    pairs = np.concatenate(found)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def _cut_by_plane(
    corners: FloatArray, normals: FloatArray, size: FloatArray, one: Pairs, other: Pairs
) -> NDArray[np.bool_]:
    """Whether the plane of each face `one` has corners of the face `other` on both sides."""
    normal, origin = normals[one], corners[one, 0]
    least = _ROUNDING * np.maximum(size[one], size[other]) ** 3
    above = np.zeros(len(one), np.bool_)
    below = np.zeros(len(one), np.bool_)
    for corner in range(3):
        height = _dot(corners[other, corner] - origin, normal)
        above |= height > least
        below |= height < -least
    return above & below


def _crossing(
    corners: FloatArray, faces: IndexArray, size: FloatArray, first: Pairs, second: Pairs
) -> Pairs:
    """The pairs that cross, the lower face first."""
    shared = faces[first][:, :, None] == faces[second][:, None, :]
    common = shared.sum(axis=(1, 2))
    crosses = np.zeros(len(first), np.bool_)
    for one, other, mine in (
        (first, second, shared.any(axis=2)),
        (second, first, shared.any(axis=1)),
    ):
        for a, b in _EDGES:
            # an edge with a shared corner only touches the other face there
            test = np.flatnonzero(~crosses & (common < 2) & ~mine[:, a] & ~mine[:, b])
            crosses[test] = _passes(
                corners[one[test], a],
                corners[one[test], b],
                corners[other[test]],
                np.maximum(size[one[test]], size[other[test]]),
            )
    return np.sort(np.stack([first[crosses], second[crosses]], axis=1), axis=1)


def _passes(
    p: FloatArray, q: FloatArray, triangle: FloatArray, scale: FloatArray
) -> NDArray[np.bool_]:
    """Whether the segments p q (k, 3) pass through the interiors of triangles (k, 3, 3).

    `scale` (k,) is their size along an axis.
    """
    a, b, c = (triangle[:, corner] - p for corner in range(3))
    ray = q - p
    normal = np.cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0])
    least = _ROUNDING * scale**3
    start = -_dot(normal, a)
    end = start + _dot(normal, ray)
    across = ((start > least) & (end < -least)) | ((start < -least) & (end > least))
    result = np.zeros(len(p), np.bool_)
    near = np.flatnonzero(across)
    a, b, c, ray, least = a[near], b[near], c[near], ray[near], least[near]
    sides = np.stack(
        [_dot(ray, np.cross(a, b)), _dot(ray, np.cross(b, c)), _dot(ray, np.cross(c, a))], axis=1
    )
    result[near] = (sides > least[:, None]).all(axis=1) | (sides < -least[:, None]).all(axis=1)
    return result


def _dot(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("ij,ij->i", x, y))
