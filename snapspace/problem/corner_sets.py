"""Orders of all pairs and all triples of the corners of a simplex, fair to the corners."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int64]


def pairs_in_rounds(corners: int) -> IntArray:
    """All pairs of 0 ... corners - 1, (corners (corners - 1) / 2, 2), round by round.

    A round is like that of a tournament (circle method: Kirkman 1847): disjoint pairs of all
    corners, or of all except one if their number is odd. So the first k pairs, for any k, contain
    each corner nearly equally often, and each corner comes first in half of its pairs.
    """
    seats = corners + corners % 2
    ring, pairs = list(range(seats)), []
    for _ in range(seats - 1):
        for low, high in zip(ring[: seats // 2], reversed(ring), strict=False):
            if max(low, high) < corners:  # else it sits out
                pair = min(low, high), max(low, high)
                pairs.append(pair if sum(pair) % 2 else pair[::-1])
        ring = [ring[0], ring[-1], *ring[1:-1]]
    return np.array(pairs, np.int64).reshape(-1, 2)


def triples_in_circles(corners: int, *, at_most: int) -> IntArray:
    """The first triples of 0 ... corners - 1, (k, 3), circle by circle, k <= C(corners, 3).

    Place the corners like the hours of a clock. A circle is the set of all rotations of one triple,
    so it contains each corner equally often. Wide triples, whose corners are spread around the
    clock, come first. The number of triples can be large: a thousand corners have 166 million.
    """
    gaps = {
        min((a, b, c), (b, c, a), (c, a, b))
        for a in range(1, corners)
        for b in range(1, corners - a)
        for c in [corners - a - b]
    }
    # hours in an order of golden steps, so that a part of a circle is spread as well
    step = next(
        s for s in range(math.ceil(0.618 * corners), 2 * corners) if math.gcd(s, corners) == 1
    )
    hours = [k * step % corners for k in range(corners)]
    triples: dict[frozenset[int], tuple[int, int, int]] = {}
    for first, second, _ in sorted(gaps, key=lambda gap: (max(gap) - min(gap), gap)):
        if len(triples) >= at_most:
            break
        for hour in hours:
            around = (hour, (hour + first) % corners, (hour + first + second) % corners)
            triples.setdefault(frozenset(around), around)
    return np.array(list(triples.values()), np.int64).reshape(-1, 3)[:at_most]
