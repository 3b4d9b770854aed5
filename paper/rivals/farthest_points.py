"""Farthest points: vertices spread evenly over a mesh (Eldar et al. 1997)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

FloatArray = NDArray[np.float64]


def farthest_points(
    vertices: FloatArray, count: int, *, given: Iterable[int] = ()
) -> NDArray[np.int64]:
    """Indices (count,) of vertices, each the farthest from all before it and from the given ones.

    Distances are those of the embedding space. Without given vertices the first is the one farthest
    from the centre.
    """
    start = list(given)
    if start:
        distance, _ = KDTree(vertices[start]).query(vertices)
    else:
        distance = np.linalg.norm(vertices - vertices.mean(axis=0), axis=1)
    chosen: list[int] = []
    for _ in range(count):
        farthest = int(np.argmax(distance))
        away = np.linalg.norm(vertices - vertices[farthest], axis=1)
        distance = away if not chosen and not start else np.minimum(distance, away)
        chosen.append(farthest)
    return np.array(chosen, np.int64)
