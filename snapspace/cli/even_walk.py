"""EvenWalk: steps along a path with even motions of the shape, as web/ui/even_walk.ts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: Shortest step; one that still moves the shape too far is not halved again.
LEAST_STEP = 1e-4
#: Longest step, for example where the shape does not move.
MOST_STEP = 0.25
#: Accepted motions of a step, relative to an even step.
SMALL, LARGE = 0.8, 1.25
#: How often one step may grow; a pace that is too slow is corrected over a few steps.
GROWTHS = 3


@dataclass(frozen=True)
class PathPoint:
    """A shape with coordinates q (d,), at a share of the path between 0 and 1."""

    share: float
    q: FloatArray


@dataclass(frozen=True)
class ShapePath:
    """The path to walk along.

    solve : gives the coordinates of the shape at a share, starting from a nearby shape
    motion : the largest motion of a vertex between two shapes
    """

    solve: Callable[[float, FloatArray], FloatArray]
    motion: Callable[[FloatArray, FloatArray], float]


@dataclass(frozen=True)
class Jump:
    """A large motion of the shape between two points that are LEAST_STEP apart."""

    before: PathPoint
    after: PathPoint
    motion: float


class EvenWalk:
    """Walks from share 0 to 1, with a motion of about `even` in each step.

    A step solves once or twice if the shape moves smoothly. A step that moves the shape too far is
    halved, down to LEAST_STEP, so no step solves more than 18 times. If the shape still moves
    farther than `jump`, this is a jump: the energy has no minimum in between.
    """

    def __init__(
        self, path: ShapePath, start: FloatArray, *, length: float, even: float, jump: float
    ):
        self._path, self._even, self._jump = path, even, jump
        self._pace = 1 / length if length > 0 else np.inf
        self.at = PathPoint(0.0, start)

    def step(self) -> Jump | None:
        """Takes a step, perhaps a shorter one at the end; returns the jump in it, if any."""
        start, path, even = self.at, self._path, self._even
        last = min(start.share + MOST_STEP, 1.0)

        def within(step: float) -> float:
            return min(start.share + max(step, LEAST_STEP), last)

        near, far, moved, growths = start, None, 0.0, 0
        share = within(self._pace * even)
        while True:
            tried = PathPoint(share, path.solve(share, near.q))
            motion = path.motion(start.q, tried.q)
            is_first = far is None
            if motion > LARGE * even:
                far = tried
            else:
                near, moved = tried, motion
            if moved >= SMALL * even:
                break
            if far is not None:
                if far.share - near.share <= 1.001 * LEAST_STEP:
                    return self._cross(start, near, far)
                middle = (near.share + far.share) / 2
                # at first as if the shape moved evenly; a jump does not, and is halved
                share = within((share - start.share) * even / motion) if is_first else middle
                if not near.share < share < far.share:
                    share = middle
            else:
                if share == last or growths == GROWTHS:
                    break
                growths += 1
                share = within((share - start.share) * min(0.98 * even / max(motion, 1e-300), 4.0))
        self._go(near, moved)
        return None

    def _cross(self, start: PathPoint, near: PathPoint, far: PathPoint) -> Jump | None:
        """Steps from `near` to `far`, which cannot be divided; returns the jump if it is one."""
        gap = self._path.motion(near.q, far.q)
        if gap <= self._jump:
            self._go(far, self._path.motion(start.q, far.q))
            return None
        self._go(near, self._path.motion(start.q, near.q))  # a jump does not show the pace
        self.at = far
        return Jump(near, far, gap)

    def _go(self, place: PathPoint, moved: float) -> None:
        step = place.share - self.at.share
        if step > 0:
            self._pace = min(step / moved if moved > 0 else np.inf, 4 * self._pace)
        self.at = place
