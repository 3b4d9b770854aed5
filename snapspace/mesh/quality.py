"""Sizes and angles: areas of triangles; volumes, longest edges and dihedral angles of tets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, IndexArray

_EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
# |volume| <= _FLAT * (longest edge)^3 counts as zero. A regular tet has 0.118; rounding of float64
# coordinates gives about 1e-16; the worst slivers of constrained TetGen meshes have about 1e-9.
_FLAT = 1e-13


def triangle_areas(vertices: FloatArray, triangles: IndexArray) -> FloatArray:
    """Areas (f,) of triangles (f, 3) between vertices (n, 3)."""
    a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
    areas: FloatArray = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
    return areas


def tet_volumes(vertices: FloatArray, tets: IndexArray) -> FloatArray:
    """Signed volumes of tets.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int, (m, 4)

    Returns
    -------
    ndarray, (m,)
        det(v1 - v0, v2 - v0, v3 - v0) / 6: positive for a right-handed tet.
    """
    corner = [np.ascontiguousarray(vertices[:, axis])[tets.T] for axis in range(3)]
    (ax, bx, cx), (ay, by, cy), (az, bz, cz) = (axis[1:] - axis[0] for axis in corner)
    volumes = ax * (by * cz - bz * cy)
    volumes += ay * (bz * cx - bx * cz)
    volumes += az * (bx * cy - by * cx)
    volumes /= 6.0
    return np.asarray(volumes, dtype=np.float64)


def longest_edges(vertices: FloatArray, tets: IndexArray) -> FloatArray:
    """Length of the longest edge of every tet, (m,)."""
    longest = np.zeros(len(tets))
    axes = [np.ascontiguousarray(vertices[:, axis]) for axis in range(3)]
    for i, j in _EDGES:
        squared = np.zeros(len(tets))
        for x in axes:
            difference = x[tets[:, i]] - x[tets[:, j]]
            squared += difference * difference
        np.maximum(longest, squared, out=longest)
    return np.asarray(np.sqrt(longest), dtype=np.float64)


def flat_tets(vertices: FloatArray, tets: IndexArray, volumes: FloatArray) -> NDArray[np.bool_]:
    """Which tets have no volume for their size: |volume| <= 1e-13 (longest edge)^3, (m,)."""
    return np.asarray(np.abs(volumes) <= _FLAT * longest_edges(vertices, tets) ** 3, dtype=np.bool_)


def turned_right(vertices: FloatArray, tets: IndexArray) -> IndexArray:
    """Tets (m, 4) with the last two corners of inverted ones exchanged: no volume is negative."""
    turned = tets.copy()
    inverted = tet_volumes(vertices, tets) < 0.0
    turned[inverted] = tets[inverted][:, [0, 1, 3, 2]]
    return turned


def dihedral_angles(vertices: FloatArray, tets: IndexArray) -> FloatArray:
    """Dihedral angles of tets in degrees, at the edges 01, 02, 03, 12, 13, 23.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int, (m, 4)
        Positive volumes.

    Returns
    -------
    ndarray, (m, 6)
        Between 0 and 180; a regular tet has arccos(1/3) = 70.53 everywhere.
    """
    corners = vertices[tets]
    angles = np.empty((len(tets), 6))
    for column, (i, j) in enumerate(_EDGES):
        k, h = (c for c in range(4) if c not in (i, j))
        edge = corners[:, j] - corners[:, i]
        first = np.cross(edge, corners[:, k] - corners[:, i])
        second = np.cross(edge, corners[:, h] - corners[:, i])
        # arctan2 keeps its accuracy near 0 and 180 degrees, where arccos loses half the digits
        sine = np.linalg.norm(np.cross(first, second), axis=1)
        angles[:, column] = np.degrees(np.arctan2(sine, np.einsum("ij,ij->i", first, second)))
    return angles
