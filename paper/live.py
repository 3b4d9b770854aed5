"""drag: what a frame of a live session takes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import snapspace as ss

#: Frames from one random point of the domain to the next: a second of a moving hand.
LEG = 60


@dataclass(frozen=True)
class Live:
    """Means over the frames of a drag.

    iterations : iterations of the minimiser in a frame
    milliseconds : of the solve of a frame, without its vertices
    per_iteration : milliseconds of an iteration; not a number if no frame took one
    """

    iterations: float
    milliseconds: float
    per_iteration: float


def drag(
    model: ss.PosingModel | ss.InterpolationModel,
    *,
    minimizer: str | None = None,
    legs: int = 2,
    seed: int = 9,
) -> Live:
    """Moves along straight lines between random parameters, `LEG` frames each.

    The first frame, a jump from tau, does not count.
    """
    corners = ss.sample(model.problem.domain, legs + 1, seed=seed)
    session = model.session(minimizer=minimizer)
    session.set_parameters(corners[0])
    reports = [
        session.set_parameters(a + (b - a) * (k / LEG))
        for a, b in pairwise(corners)
        for k in range(1, LEG + 1)
    ]
    iterations = sum(report.iterations for report in reports)
    milliseconds = 1e3 * sum(report.seconds for report in reports)
    return Live(
        iterations=iterations / len(reports),
        milliseconds=milliseconds / len(reports),
        per_iteration=milliseconds / iterations if iterations else math.nan,
    )
