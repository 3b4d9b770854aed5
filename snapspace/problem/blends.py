"""Blends of two, three and all corners of a simplex, in an order for many poses."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers
from ..mesh import as_shape
from .corner_sets import pairs_in_rounds, triples_in_circles

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

# Shares of pairs, triples and interior points: until every pair has had a point, and afterwards.
# Chosen on three generated sets of poses and tested on others, see docs/notes/sampling.md.
_FIRST_SWEEP = (0.9, 0.0, 0.1)
_AFTERWARDS = (0.2, 0.3, 0.5)
_PAIR, _TRIPLE, _INSIDE = range(3)


def blend_weights(inside: FloatArray, *, lowest: float, order: IntArray) -> FloatArray:
    """Weights in an order in which the first samples, however many, are a sensible set.

    First come the midpoints of all pairs, with one interior point in ten samples. Then, out of ten
    samples, two are further points of pairs, three are points of triples, and five are interior
    points. A pair gets its next point after all other pairs have had theirs, and so does a triple.
    Points of pairs are at 1/2, 1/4, 3/4, 1/8, ... (van der Corput 1935). Those of triples are first
    at the middle, then nearer to each corner, and so on (Basu & Owen 2015).

    Parameters
    ----------
    inside : ndarray, (k, corners)
        Points of the whole domain; the interior points are the first of these.
    lowest : float
        Smallest weight of the domain, zero or negative. Pairs and triples are enlarged so that
        their weights reach down to it, while all others stay zero.
    order : ndarray of int, (corners,)
        A permutation of the corners, which determines the pairs that come first.

    Returns
    -------
    ndarray, (k, corners)
        Row i depends on i and the arguments, not on k. Rows sum to one up to rounding.
    """
    count, corners = inside.shape
    weights = np.zeros((count, corners))
    triples = triples_in_circles(corners, at_most=count)
    sets = {_PAIR: order[pairs_in_rounds(corners)], _TRIPLE: order[triples]}
    points = {_PAIR: _on_edge, _TRIPLE: _in_triangle}
    for row, (kind, number) in zip(weights, _kinds(count, corners), strict=True):
        if kind == _INSIDE:
            row[:] = inside[number]
            continue
        # if the list of triples was cut off, it has as many triples as samples: one sweep at most
        sweep, place = divmod(number, len(sets[kind]))
        chosen = sets[kind][place]
        row[chosen] = lowest + (1.0 - len(chosen) * lowest) * points[kind](sweep)
    return weights


def _kinds(count: int, corners: int) -> list[tuple[int, int]]:
    """For each sample, its kind and how many of that kind came before it."""
    pairs = corners * (corners - 1) // 2
    before, kinds = [0, 0, 0], []
    shares, since = np.array(_FIRST_SWEEP), np.zeros(3)
    for _ in range(count):
        if before[_PAIR] == pairs and shares[_TRIPLE] == 0.0 and corners > 2:
            shares, since = np.array(_AFTERWARDS), np.zeros(3)
        # the kind that is farthest behind its share
        kind = int(np.argmax(shares * (since.sum() + 1.0) - since))
        kinds.append((kind, before[kind]))
        before[kind] += 1
        since[kind] += 1.0
    return kinds


def _on_edge(number: int) -> FloatArray:
    """Weights (2,) of a point of the van der Corput sequence in base two, without its zero."""
    digits, share, place = number + 1, 0.0, 0.5
    while digits:
        digits, digit = divmod(digits, 2)
        share += place * digit
        place *= 0.5
    return np.array([share, 1.0 - share])


def _in_triangle(number: int) -> FloatArray:
    """Weights (3,) of a point of the triangular van der Corput sequence (Basu & Owen 2015).

    The midpoints of a triangle's sides split it into four triangles. Each digit in base four
    selects one of them, the inner one or one at a corner, and the point is the centre of the last.
    """
    triangle = np.eye(3)
    digits = number
    while digits:
        digits, digit = divmod(digits, 4)
        if digit == 0:
            triangle = 0.5 * (triangle.sum(axis=0) - triangle)
        else:
            triangle = 0.5 * (triangle + triangle[digit - 1])
    middle: FloatArray = triangle.mean(axis=0)
    return middle


def shape_and_weights(
    x: ArrayLike, weights: ArrayLike, size: int, count: int
) -> tuple[FloatArray, FloatArray]:
    """A shape (size,) and weights (count,) as float64; ValueError for other numbers of them."""
    positions = as_shape(x, size, who="InterpolationProblem")
    w = as_numbers("InterpolationProblem", "weights", weights)
    if w.shape != (count,):
        raise ValueError(
            f"InterpolationProblem: weights have shape {w.shape}, but must be ({count},), one per "
            "pose"
        )
    return positions, w
