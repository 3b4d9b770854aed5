"""Hinges: the edges at which two triangles of a surface meet."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IndexArray


def hinges_of(triangles: IndexArray) -> IndexArray:
    """The hinges of an oriented manifold surface.

    Parameters
    ----------
    triangles : ndarray of int, (f, 3)
        At most two meet at an edge, and run along it in opposite directions.

    Returns
    -------
    ndarray of int32, (h, 4)
        Vertices v0, v1, v2, v3: the edge v0 v1 is common to the triangles v0 v1 v2 and v1 v0 v3.
        One row per edge between two triangles, ordered by the triangles v0 v1 v2; v0 < v1.
    """
    first = triangles.astype(np.int64)
    second, third = np.roll(first, -1, axis=1).ravel(), np.roll(first, -2, axis=1).ravel()
    first = first.ravel()
    along, against = first << 32 | second, second << 32 | first
    order = np.argsort(against)
    places = np.searchsorted(against[order], along)
    places = order[np.minimum(places, len(order) - 1)]
    chosen = (against[places] == along) & (first < second)
    rows = np.stack([first, second, third, third[places]], axis=1)[chosen]
    return np.ascontiguousarray(rows, np.int32)


def hinge_measures(vertices: FloatArray, hinges: IndexArray) -> FloatArray:
    """A third of the area of both triangles over the mean square of the hinge's angle, (h,).

    The mean is over cylinders of radius one that touch the hinge in all directions. Half of the
    measure times the bending stiffness times the squared angle is the energy of a hinge: averaged
    over directions, it is that of a plate, for triangles of any shape. With equilateral triangles
    it is |edge|^2 / (sum of both areas), as in Grinspun, Hirani, Desbrun, Schroeder 2003.
    """
    start = vertices[hinges[:, 0]]
    edge, first, second = (vertices[hinges[:, k]] - start for k in (1, 2, 3))
    length = np.linalg.norm(edge, axis=1)
    up = np.linalg.norm(np.cross(edge, first), axis=1) / length
    down = np.linalg.norm(np.cross(edge, second), axis=1) / length
    x = np.stack([length, *(np.einsum("hi,hi->h", edge, e) / length for e in (first, second))])
    y = np.stack([np.zeros_like(up), up, -down])
    # heights of the corners times these are the angle; the first corner is the origin
    row = np.stack([-(x[1] / up + x[2] / down) / length, 1.0 / up, 1.0 / down])
    # with heights (point . direction)^2 / 2 the angle is a quadratic form of the direction
    xx, yy, xy = (0.5 * (row * a * b).sum(axis=0) for a, b in ((x, x), (y, y), (x, y)))
    mean_square = (2.0 * (xx**2 + yy**2 + 2.0 * xy**2) + (xx + yy) ** 2) / 8.0
    return np.asarray((up + down) * length / 6.0 / mean_square)


def hinge_triangles(triangles: IndexArray, hinges: IndexArray) -> IndexArray:
    """The two triangles of each hinge, (h, 2)."""
    first = triangles.astype(np.int64)
    keys = (first << 32 | np.roll(first, -1, axis=1)).ravel()
    order = np.argsort(keys)
    pairs = hinges[:, [[0, 1], [1, 0]]].astype(np.int64)
    wanted = pairs[..., 0] << 32 | pairs[..., 1]
    return np.asarray(order[np.searchsorted(keys[order], wanted)] // 3, dtype=np.int32)
