"""A walk by even motions of a shape, as web/ui/even_walk.ts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: A step that moves the shape too far all the same, although it is no longer than this.
LEAST_STEP = 1e-4
#: Where the shape rests a step is no more of the way.
MOST_STEP = 0.25
#: Of an even step.
SMALL, LARGE = 0.8, 1.25
#: Of one step: a pace that is too slow is found over a few.
GROWTHS = 3


@dataclass(frozen=True)
class PathPoint:
    """A shape on the way, by its coordinates q (d,), at a share of it between 0 and 1."""

    share: float
    q: FloatArray


@dataclass(frozen=True)
class ShapePath:
    """What is walked: shapes by their share of it, solved for from one near, and how far they move.

    A motion is the largest of a vertex between two shapes.
    """

    solve: Callable[[float, FloatArray], FloatArray]
    motion: Callable[[FloatArray, FloatArray], float]


@dataclass(frozen=True)
class Jump:
    """Between two places that are LEAST_STEP apart the shape moves so far."""

    before: PathPoint
    after: PathPoint
    motion: float


class EvenWalk:
    """Walks from share 0 to 1, with a motion of about `even` in each step.

    A step solves once or twice where the shape moves smoothly. One that moves it too far is halved
    down to LEAST_STEP, so that none solves more than 18 times. What still moves it farther than
    `jump` is a jump: the energy has no minimum between.
    """

    def __init__(
        self, way: ShapePath, start: FloatArray, *, length: float, even: float, jump: float
    ):
        self._way, self._even, self._jump = way, even, jump
        self._pace = 1 / length if length > 0 else np.inf
        self.at = PathPoint(0.0, start)

    def step(self) -> Jump | None:
        """Takes a step, a shorter one at the end of the way; the jump in it, if there is one."""
        start, way, even = self.at, self._way, self._even
        last = min(start.share + MOST_STEP, 1.0)

        def within(step: float) -> float:
            return min(start.share + max(step, LEAST_STEP), last)

        near, far, moved, growths = start, None, 0.0, 0
        share = within(self._pace * even)
        while True:
            tried = PathPoint(share, way.solve(share, near.q))
            motion = way.motion(start.q, tried.q)
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
                # the first time as if it moved evenly; what jumps does not, and is halved
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
        """Between `near` and `far` there is no smaller step."""
        gap = self._way.motion(near.q, far.q)
        if gap <= self._jump:
            self._go(far, self._way.motion(start.q, far.q))
            return None
        self._go(near, self._way.motion(start.q, near.q))  # a jump tells nothing of the pace
        self.at = far
        return Jump(near, far, gap)

    def _go(self, place: PathPoint, moved: float) -> None:
        step = place.share - self.at.share
        if step > 0:
            self._pace = min(step / moved if moved > 0 else np.inf, 4 * self._pace)
        self.at = place
