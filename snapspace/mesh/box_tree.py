"""BoxTree: finds the boxes that are near each of many points."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray
from .morton_code import morton_codes

_MOST = 1 << 18  # pairs of nodes at a time

Pairs = tuple[NDArray[np.intp], NDArray[np.intp]]


class BoxTree:
    """A balanced binary tree over axis-aligned boxes in Morton order.

    Parameters
    ----------
    low, high : ndarray, (m, 3)
        Opposite corners of the boxes, m > 0.

    Notes
    -----
    Karras, "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees", 2012,
    orders boxes in this way. The tree is stored level by level, so that a query takes a few array
    operations per level for all points together.
    """

    def __init__(self, low: FloatArray, high: FloatArray) -> None:
        self._order = np.argsort(morton_codes((low + high) / 2.0), kind="stable")
        depth = max(0, len(low) - 1).bit_length()
        # empty boxes, infinitely far from everything, fill the last level
        lows, highs = np.full((2**depth, 3), np.inf), np.full((2**depth, 3), -np.inf)
        lows[: len(low)], highs[: len(low)] = low[self._order], high[self._order]
        self._levels = [(lows, highs)]
        for _ in range(depth):
            lows = np.minimum(lows[0::2], lows[1::2])
            highs = np.maximum(highs[0::2], highs[1::2])
            self._levels.append((lows, highs))
        self._levels.reverse()

    def within(self, points: FloatArray, distances: FloatArray) -> Pairs:
        """All pairs of a point and a box that is no farther from it than its given distance.

        Parameters
        ----------
        points : ndarray, (k, 3)
        distances : ndarray, (k,)
            Largest distance for each point; zero finds the boxes that contain it, boundary
            included.

        Returns
        -------
        points, boxes : ndarray of int
            Indices, one of each per pair, sorted by point.
        """
        squared = distances**2
        point, node = np.arange(len(points)), np.zeros(len(points), np.intp)
        for level, (low, high) in enumerate(self._levels):
            if level:
                point = np.repeat(point, 2)
                node = (2 * node[:, None] + np.arange(2)).ravel()
            here = points[point]
            gap = np.maximum(np.maximum(low[node] - here, here - high[node]), 0.0)
            near = np.einsum("ij,ij->i", gap, gap) <= squared[point]
            point, node = point[near], node[near]
        return point, self._order[node]

    def overlapping(self) -> Iterator[Pairs]:
        """All pairs of different boxes that overlap or touch, each pair once, in blocks."""
        root = np.zeros(1, np.intp)
        stack = [(0, root, root)]
        while stack:
            level, left, right = stack.pop()
            if level == len(self._levels) - 1:
                different = left != right
                if different.any():
                    yield self._order[left[different]], self._order[right[different]]
                continue
            left, right = _children(left, right)
            low, high = self._levels[level + 1]
            for axis in range(3):  # one axis at a time is twice as fast as all three at once
                lows, highs = low[:, axis], high[:, axis]
                near = (lows[left] <= highs[right]) & (lows[right] <= highs[left])
                left, right = left[near], right[near]
            stack += [
                (level + 1, left[start : start + _MOST], right[start : start + _MOST])
                for start in range(0, len(left), _MOST)
            ]


def _children(left: NDArray[np.intp], right: NDArray[np.intp]) -> Pairs:
    """Pairs of the children of pairs of nodes; for a node with itself, each pair once."""
    first = (2 * left[:, None] + np.array([0, 0, 1, 1])).ravel()
    second = (2 * right[:, None] + np.array([0, 1, 0, 1])).ravel()
    once = first <= second
    return first[once], second[once]
