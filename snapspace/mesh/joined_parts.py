"""joined_parts: components of tets, joined where two of them have vertices at one position."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IndexArray
from .components import tet_components


def joined_parts(points: FloatArray, tets: IndexArray) -> tuple[FloatArray, IndexArray, int]:
    """Merges vertices of different components that have the same position.

    Programs that store a value per corner of each tet, or one mesh per material, write such meshes.
    Vertices of one component stay apart, since they may be the two sides of a slit.

    Parameters
    ----------
    points : (n, 3)
    tets : (m, 4)

    Returns
    -------
    points : (k, 3), without the merged vertices
    tets : (m, 4) int32
    merged : number of merged vertices, n - k
    """
    component = tet_components(tets, len(points))
    count = int(component.max()) + 1
    if count == 1:
        return points, tets, 0
    of_vertex = np.full(len(points), -1, np.intp)
    of_vertex[tets] = component[:, None]
    used = np.flatnonzero(of_vertex >= 0)
    _, first, group = np.unique(points[used], axis=0, return_index=True, return_inverse=True)
    group = group.reshape(-1)
    low, high = np.full(len(first), count, np.intp), np.zeros(len(first), np.intp)
    np.minimum.at(low, group, of_vertex[used])
    np.maximum.at(high, group, of_vertex[used])
    shared = (low < high)[group]
    target = np.arange(len(points))
    target[used[shared]] = used[first[group[shared]]]
    kept = target == np.arange(len(points))
    new_index: IndexArray = np.cumsum(kept, dtype=np.int32) - np.int32(1)
    return points[kept], new_index[target][tets], int(np.count_nonzero(~kept))
