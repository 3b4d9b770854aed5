"""drag: the cost of a frame of a live session."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

import snapspace as ss

#: Frames from one random point of the domain to the next: a second of a moving hand.
LEG = 60


@dataclass(frozen=True)
class Live:
    """Frames of a drag.

    iterations : mean number of iterations of the minimiser in a frame
    per_iteration : milliseconds, median of the frames that took any; None if none did
    milliseconds : median time of a frame's solve, without computing the vertices
    """

    iterations: float
    per_iteration: float | None
    milliseconds: float


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
    steps = [1e3 * report.seconds / report.iterations for report in reports if report.iterations]
    return Live(
        iterations=float(np.mean([report.iterations for report in reports])),
        per_iteration=float(np.median(steps)) if steps else None,
        milliseconds=float(np.median([1e3 * report.seconds for report in reports])),
    )
