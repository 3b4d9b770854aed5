"""Merging points that are equal, or close to each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..arrays import FloatArray


def equal_points(points: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Groups points with the same coordinates.

    Parameters
    ----------
    points : ndarray, (k, 3)
        0.0 and -0.0 are the same.

    Returns
    -------
    first : ndarray of int, (n,)
        The first point of each group, ascending.
    group : ndarray of int, (k,)
        Group of each point: `points[first][group]` equals `points`.
    """
    positive = np.ascontiguousarray(points) + 0.0  # -0.0 + 0.0 is 0.0
    bits = positive.view(np.uint64)
    # odd multipliers: different bits rarely have the same key, and the result is checked
    odd = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)
    mixed = bits * odd
    mixed ^= mixed >> np.uint64(29)
    keys = (mixed * odd[::-1]).sum(axis=1, dtype=np.uint64)
    _, first, group = np.unique(keys, return_index=True, return_inverse=True)
    group = group.reshape(-1)
    if not np.array_equal(positive[first][group], positive, equal_nan=True):
        _, first, group = np.unique(positive, axis=0, return_index=True, return_inverse=True)
        group = group.reshape(-1)
    return in_order(first, group)


def close_points(points: FloatArray, distance: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Groups points that are at most `distance` from another of the group, as `equal_points`.

    For example points that two programs or two frames have rounded differently.
    """
    pairs = cKDTree(points).query_pairs(distance, output_type="ndarray")
    edges = coo_array(
        (np.ones(len(pairs), np.int8), (pairs[:, 0], pairs[:, 1])), shape=(len(points),) * 2
    )
    _, labels = connected_components(edges, directed=False)
    _, first, group = np.unique(labels, return_index=True, return_inverse=True)
    return in_order(first, group.reshape(-1))


def in_order(
    first: NDArray[np.intp], group: NDArray[np.intp]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The first members of groups, ascending, and each member's group, numbered in this order."""
    order = np.argsort(first, kind="stable")
    rank = np.empty(len(order), np.intp)
    rank[order] = np.arange(len(order))
    return first[order], rank[group]
