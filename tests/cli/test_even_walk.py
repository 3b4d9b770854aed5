"""A walk in even motions along curves whose motions are known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from snapspace.cli.even_walk import LARGE, LEAST_STEP, SMALL, EvenWalk, Jump, ShapePath

EVEN = 0.02
MOST_SOLVES = 18


@dataclass
class Walked:
    """Share, motion and number of solves of every step, and the jumps."""

    shares: list[float] = field(default_factory=list)
    motions: list[float] = field(default_factory=list)
    solves: list[int] = field(default_factory=list)
    jumps: list[Jump] = field(default_factory=list)


def walked(curve: Callable[[float, float], float], *, length: float) -> Walked:
    """Walks to the end of the curve x(share, previous x)."""
    result = Walked()

    def solve(share: float, near: np.ndarray) -> np.ndarray:
        result.solves[-1] += 1
        return np.array([curve(share, near[0])])

    path = ShapePath(solve, lambda a, b: float(abs(b - a)[0]))
    walk = EvenWalk(path, np.array([curve(0.0, 0.0)]), length=length, even=EVEN, jump=4 * EVEN)
    while walk.at.share < 1:
        before = walk.at
        result.solves.append(0)
        jump = walk.step()
        assert walk.at.share > before.share, "every step advances"
        result.jumps += [jump] if jump else []
        result.shares.append(walk.at.share)
        result.motions.append(float(abs(walk.at.q - before.q)[0]))
    assert max(result.solves) <= MOST_SOLVES
    return result


def test_where_the_shape_moves_fast_shares_grow_slowly() -> None:
    """Its speed is nearly zero at the ends and 30 in the middle."""
    found = walked(lambda share, _: float(np.tanh(30 * (share - 0.5))), length=1.0)
    motions, shares = np.array(found.motions), np.array(found.shares)
    assert not found.jumps and motions.max() <= LARGE * EVEN
    moving = np.abs(shares - 0.5) < 0.06
    assert moving.sum() > 60 and motions[moving].min() >= SMALL * EVEN
    assert np.mean(found.solves) < 2


def bistable(share: float, near: float) -> float:
    """The minimum of x^4/4 - x^2/2 - f x that descent finds; for f > 0.385 there is only one."""
    force = 1.2 * (share - 0.5)
    x = near if share else -1.2
    for _ in range(4000):
        x -= 0.05 * (x**3 - x - force)
    return x


def test_a_jump_is_located_and_all_else_is_even() -> None:
    found = walked(bistable, length=2.0)
    (jump,) = found.jumps
    fold = 0.5 + 2 / (3 * np.sqrt(3)) / 1.2
    assert abs(jump.after.share - fold) < 20 * LEAST_STEP, "descents are slow at a fold"
    assert jump.after.share - jump.before.share <= 1.001 * LEAST_STEP
    assert jump.motion > 1.5, "from one minimum to the other"
    others = np.delete(found.motions, found.shares.index(jump.after.share))
    assert (others > LARGE * EVEN).sum() <= 1, "only the last one before the fold"
    assert others.max() <= 4 * EVEN
    assert len(others) < 120, "it does not creep towards the jump"


def test_a_steep_part_is_not_a_jump() -> None:
    found = walked(lambda share, _: float(np.tanh(200 * (share - 0.505))), length=2.0)
    assert not found.jumps and max(found.motions) <= LARGE * EVEN


def test_a_shape_at_rest_is_passed_in_a_few_steps() -> None:
    assert len(walked(lambda share, _: 1.0, length=0.0).shares) <= 5
