"""Plan: how samples, dimension and target are chosen for a kind of problem."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..cubature import has_stars
from ..problem import InterpolationProblem, PosingProblem
from ..sampling import Method
from .checks import FEWEST_HELD_OUT

FloatArray = NDArray[np.float64]

#: Growth of the number of training samples from stage to stage.
MORE_SAMPLES = 1.5
#: Default limit on samples of the largest meshes.
FEWER_SAMPLES = 160


@dataclass(frozen=True, kw_only=True)
class Plan:
    """How samples and dimension are chosen.

    target : error of unseen samples that is good enough
    typical : the statistic of these errors that is compared with the target
    typical_name, unseen_name : names of the statistic and of unseen samples, for the user
    sampling : method of the samples
    first : number of training samples of the first stage
    pilot : number of them that make a model which predicts the others; then every stage makes a
        model that predicts the next one. 0: only models that may meet the target are made
    slow : the pilot's model predicts others only if its samples take more evaluations, on average
    trusts_predictions : whether the held-out samples are predicted as well, and the first model is
        expected to have the ratio of the predicting model, not `first_ratio`
    held_out : number of samples that judge models
    held_out_tolerance : their tolerance, relative to that of the others
    first_ratio : assumed ratio of errors of reduced solutions to those of projections, before it is
        measured. Too low a ratio wastes models that miss the target; too high a ratio wastes
        samples
    most_dimensions : limit of the dimension, so that a frame of a drag takes about 1 ms
    impression, impression_dimension : number of loosely solved samples of the preliminary model,
        see `growing_models`, and its dimension
    most_samples : default limit on samples of small meshes
    most_vertices : limit on the vertices of all samples together, if that gives fewer than
        `most_samples` and more than 160 samples
    enough_samples : number of samples that the largest dimension needs
    enough_vertices : limit on the vertices of up to `enough_samples` samples: a minute on two cores
    predicted_vertices : the same where models predict samples
    looser_if_large : factor of the samples' tolerance for bodies that get 160 of them, `is_large`
    """

    target: float
    typical: Callable[[FloatArray], float]
    typical_name: str
    unseen_name: str
    sampling: Method
    first: int
    pilot: int
    slow: float
    trusts_predictions: bool
    held_out: int
    held_out_tolerance: float
    first_ratio: float
    most_dimensions: int
    impression: int
    impression_dimension: int
    most_samples: int
    most_vertices: int
    enough_samples: int
    enough_vertices: int
    predicted_vertices: int
    looser_if_large: float

    def fitting(self, most: int) -> Plan:
        """The plan for at most `most` samples: both parts of the first stage shrink to fit."""
        together = self.first + self.held_out
        if most >= together:
            return self
        held_out = max(FEWEST_HELD_OUT, self.held_out * most // together)
        first = most - held_out
        return replace(self, first=first, pilot=min(self.pilot, first // 2), held_out=held_out)

    def stages(self, most: int) -> list[int]:
        """Numbers of samples of all stages, including held-out ones, up to `most`."""
        training = float(self.first)
        stages = [self.first + self.held_out]
        while stages[-1] < most:
            training *= MORE_SAMPLES
            stages.append(min(round(training) + self.held_out, most))
        return stages


#: For blends of generated and real poses the ratio is 2 to 14. Blends of surfaces are predicted:
#: from a model's solutions, held-out samples end near their only minimum, and the ratio of a
#: predicting model is near that of the first one (docs/notes/surface-blends.md).
BLENDS = Plan(
    target=0.005,
    typical=lambda errors: float(np.mean(errors)),
    typical_name="mean",
    unseen_name="blends",
    sampling="blends",
    first=32,
    pilot=16,
    slow=0.0,
    trusts_predictions=True,
    held_out=12,
    held_out_tolerance=0.1,
    first_ratio=8.0,
    most_dimensions=200,
    impression=0,
    impression_dimension=0,
    most_samples=640,
    most_vertices=2_000_000,
    enough_samples=640,
    enough_vertices=2_000_000,
    predicted_vertices=2_000_000,
    looser_if_large=1.0,
)
#: Blends of as-rigid-as-possible surfaces. Their energies have no cubature error, so more
#: dimensions help, and samples are predicted. Ten Lions have errors of 0.0138 with 640 samples and
#: 200 dimensions, 0.0101 with 400 and 256, and 0.0092 with 640 and 256.
RIGID_BLENDS = replace(
    BLENDS, held_out_tolerance=0.01, most_dimensions=256, predicted_vertices=2_500_000
)
#: For motions the ratio is 3 to 7. The ratio of predicting models is far higher and falls with the
#: dimension, from 72 to 45 or 98 to 29, so using it would waste samples. There may be several
#: minima.
MOTIONS = Plan(
    target=0.003,
    typical=lambda errors: float(np.median(errors)),
    typical_name="median",
    unseen_name="motions",
    sampling="sobol",
    first=80,
    pilot=32,
    slow=110.0,
    trusts_predictions=False,
    held_out=16,
    held_out_tolerance=0.01,
    first_ratio=4.0,
    most_dimensions=320,
    impression=36,
    impression_dimension=28,
    most_samples=1280,
    most_vertices=6_000_000,
    enough_samples=421,
    enough_vertices=12_000_000,
    predicted_vertices=24_000_000,
    looser_if_large=10.0,
)


def plan_of(problem: PosingProblem | InterpolationProblem) -> Plan:
    """The plan for a problem. Two poses use Sobol points, as `blends` adds only their middle."""
    if isinstance(problem, PosingProblem):
        plan = MOTIONS
    else:
        plan = RIGID_BLENDS if has_stars(problem) else BLENDS
    if plan is not MOTIONS and problem.parameter_count <= 2:
        plan = replace(plan, sampling="sobol")
    return plan if problem.solving.seeded_tolerance else replace(plan, pilot=0)


def is_large(problem: PosingProblem | InterpolationProblem) -> bool:
    """Whether a mesh is so large that it gets only 160 samples: for motions, 75,000 vertices.

    The error of spanning so little is then larger than that of looser solves. For a creature, a bar
    and a tripod of 250,000 to 400,000 tets, 160 samples with a tolerance of 1e-6 give the same
    errors as with 1e-7, to 4 %, in two thirds of the time. With more samples looser solves cost
    accuracy: for a creature of 300,000 tets, 202 samples leave 0.0063 instead of 0.0043.
    """
    return usual_most_samples(problem) == FEWER_SAMPLES


def usual_most_samples(problem: PosingProblem | InterpolationProblem) -> int:
    """Default limit on samples: fewer on larger meshes, but at least 160.

    More samples than the largest dimension needs hardly help. A Spot with three handles has errors
    of 0.0147 with 375 samples and 0.0144 with 750; an armadillo has 0.0022 with 453 and 0.0024 with
    907. Fewer samples hurt: 188 and 376 leave 0.0064 and 0.0023 on the Dragon with three handles,
    and 185 and 371 leave 0.0027 and 0.0017 on the dog's head.
    """
    plan = plan_of(problem)
    count = len(problem.mesh.vertices)
    enough = min(plan.enough_samples, plan.enough_vertices // count)
    return min(plan.most_samples, max(FEWER_SAMPLES, plan.most_vertices // count, enough))


def predicted_most_samples(problem: PosingProblem | InterpolationProblem) -> int:
    """Default limit on samples if a pilot predicts them, which takes less time for each."""
    plan = plan_of(problem)
    enough = min(plan.enough_samples, plan.predicted_vertices // len(problem.mesh.vertices))
    return max(usual_most_samples(problem), enough)
