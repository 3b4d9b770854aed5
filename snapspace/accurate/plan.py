"""Plan: what a kind of problem asks of samples, dimensions and errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..sampling import Method
from .checks import FEWEST_HELD_OUT

FloatArray = NDArray[np.float64]

#: Growth of the samples that train, from stage to stage.
MORE_SAMPLES = 1.5
#: The most samples of large meshes by default.
FEWER_SAMPLES = 160


@dataclass(frozen=True, kw_only=True)
class Plan:
    """How samples and dimension are chosen.

    target : error of unseen samples that is good enough
    typical : of these errors, what is compared with the target
    typical_name, unseen_name : of these, for people
    sampling : method of the samples
    first : samples of the first stage that train
    held_out : samples that judge
    first_ratio : errors of reduced solutions over those of projections, before it is measured; too
        low a one costs models that miss the target
    most_dimensions : so that a frame of a drag takes up to a millisecond
    impression, impression_dimension : loosely solved samples of a first impression, see
        `growing_models`, and the dimension of its model
    most_samples : of small meshes, by default
    most_vertices : of all samples together, where that is less than `most_samples` and more than
        160 samples: half a minute on two cores
    looser_if_large : factor of the tolerance of samples of bodies that get 160 of them, `is_large`
    """

    target: float
    typical: Callable[[FloatArray], float]
    typical_name: str
    unseen_name: str
    sampling: Method
    first: int
    held_out: int
    first_ratio: float
    most_dimensions: int
    impression: int
    impression_dimension: int
    most_samples: int
    most_vertices: int
    looser_if_large: float

    def fitting(self, most: int) -> Plan:
        """With at most so many samples; both parts shrink alike where the first stage has more."""
        together = self.first + self.held_out
        if most >= together:
            return self
        held_out = max(FEWEST_HELD_OUT, self.held_out * most // together)
        return replace(self, first=most - held_out, held_out=held_out)

    def stages(self, most: int) -> list[int]:
        """Numbers of samples, the held-out ones among them, up to the most."""
        training = float(self.first)
        stages = [self.first + self.held_out]
        while stages[-1] < most:
            training *= MORE_SAMPLES
            stages.append(min(round(training) + self.held_out, most))
        return stages


#: Ratios of blends of generated and real poses are 2 to 14.
BLENDS = Plan(
    target=0.005,
    typical=lambda errors: float(np.mean(errors)),
    typical_name="mean",
    unseen_name="blends",
    sampling="blends",
    first=32,
    held_out=12,
    first_ratio=8.0,
    most_dimensions=200,
    impression=0,
    impression_dimension=0,
    most_samples=640,
    most_vertices=2_000_000,
    looser_if_large=1.0,
)
#: Ratios of motions are 3 to 7.
MOTIONS = Plan(
    target=0.003,
    typical=lambda errors: float(np.median(errors)),
    typical_name="median",
    unseen_name="motions",
    sampling="sobol",
    first=80,
    held_out=16,
    first_ratio=4.0,
    most_dimensions=256,
    impression=36,
    impression_dimension=28,
    most_samples=1280,
    most_vertices=6_000_000,
    looser_if_large=10.0,
)


def plan_of(problem: PosingProblem | InterpolationProblem) -> Plan:
    """That of its kind; two poses take Sobol points, since `blends` adds only their middle."""
    if isinstance(problem, PosingProblem):
        return MOTIONS
    return BLENDS if problem.parameter_count > 2 else replace(BLENDS, sampling="sobol")


def is_large(problem: PosingProblem | InterpolationProblem) -> bool:
    """Whether the vertices allow no more than the fewest samples, as 37,500 do of motions.

    What these few samples do not span is then more than what is left of looser solves: a creature,
    a bar and a tripod of 250,000 to 400,000 tets have the same errors, to 4 %, with samples of 1e-6
    as of 1e-7, in two thirds of the time. Smaller bodies lose up to half as much again.
    """
    return usual_most_samples(problem) == FEWER_SAMPLES


def usual_most_samples(problem: PosingProblem | InterpolationProblem) -> int:
    """The most samples by default: fewer on larger meshes, but 160 at least."""
    plan = plan_of(problem)
    fitting = plan.most_vertices // len(problem.mesh.vertices)
    return min(plan.most_samples, max(FEWER_SAMPLES, fitting))
