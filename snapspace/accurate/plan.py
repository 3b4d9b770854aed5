"""Plan: what a kind of problem asks of samples, dimensions and errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..sampling import Method

FloatArray = NDArray[np.float64]

#: The most samples by default: 640, but no more than this many vertices in all where 160 are that
#: many. They take as long as half a minute on small meshes, and a minute on large ones.
MOST_SAMPLES, FEWER_SAMPLES, MOST_VERTICES = 640, 160, 2_000_000


@dataclass(frozen=True, kw_only=True)
class Plan:
    """How samples and dimension are chosen.

    typical : of the errors of unseen samples, what is compared with the target
    typical_name, unseen_name : of these, for people
    sampling : method of the samples
    first : samples of the first stage that train
    held_out : samples that judge
    first_ratio : errors of reduced solutions over those of projections, before it is measured; too
        low a one costs models that miss the target
    most_dimensions : so that a frame of a drag takes up to a millisecond
    """

    typical: Callable[[FloatArray], float]
    typical_name: str
    unseen_name: str
    sampling: Method
    first: int
    held_out: int
    first_ratio: float
    most_dimensions: int


def plan_of(problem: PosingProblem | InterpolationProblem) -> Plan:
    """Blends of two poses are Sobol points: `blends` has the middle only once, and then uniform.

    Ratios are 2 to 14 for blends of generated and real poses, and 2 to 6 for motions.
    """
    if isinstance(problem, InterpolationProblem):
        return Plan(
            typical=lambda errors: float(np.mean(errors)),
            typical_name="mean",
            unseen_name="blends",
            sampling="blends" if problem.parameter_count > 2 else "sobol",
            first=32,
            held_out=12,
            first_ratio=8.0,
            most_dimensions=200,
        )
    return Plan(
        typical=lambda errors: float(np.median(errors)),
        typical_name="median",
        unseen_name="motions",
        sampling="sobol",
        first=80,
        held_out=16,
        first_ratio=4.0,
        most_dimensions=160,
    )


def usual_most_samples(problem: PosingProblem | InterpolationProblem) -> int:
    """The most samples by default: 640, on large meshes fewer, but 160 at least."""
    fitting = MOST_VERTICES // len(problem.mesh.vertices)
    return min(MOST_SAMPLES, max(FEWER_SAMPLES, fitting))
