"""accurate_model: as many samples and dimensions as an error of unseen parameters asks for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import asdict, dataclass, replace
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel, reduce
from ..snapshots import Checkpoint, Progress, Snapshots, SolverOptions
from ..subspace import snapshot_pca
from ..validation import unseen_errors
from .growing_samples import GrowingSamples
from .plan import Plan, plan_of, usual_most_samples

FloatArray = NDArray[np.float64]
Tell = Callable[[str], None]
Model = PosingModel | InterpolationModel

#: Fewest samples, and fewest of them that judge.
FEWEST_SAMPLES, FEWEST_HELD_OUT = 20, 4
#: Growth of the samples that train, from stage to stage.
MORE_SAMPLES = 1.5
#: Modes for each solution that they come from: the last ones fit these alone.
MODES_PER_SOLUTION = 0.8
#: The least growth of the dimension from try to try.
GROWTH = 1.2
#: Where more dimensions leave more than this share of the error, still more are of no use.
FALL = 0.9
#: What the next try aims below the target by.
MARGIN = 1.1


@dataclass(frozen=True)
class Step:
    """One model that was tried.

    samples : solved by then
    dimension : d
    projection : error of the held-out samples' projections, the mean for blends and the median for
        motions
    error : of their reduced solutions, the same
    mean, ninth : mean and 90th percentile of the latter
    unseen, typical : what was held out, and what of its errors `error` is, for people
    """

    samples: int
    dimension: int
    projection: float
    error: float
    mean: float
    ninth: float
    unseen: str
    typical: str

    def __str__(self) -> str:
        return (
            f"{self.samples} samples, d = {self.dimension}: error of unseen {self.unseen} "
            f"{100 * self.error:.2g} %, of their projections {100 * self.projection:.2g} %"
        )


@dataclass(frozen=True)
class AccurateModel:
    """A model of motions or blends, and how it came about.

    model : the first that met the target, or else that with the least error
    snapshots : all samples, those that were held out among them
    held_out : (k,), which these are
    steps : the models that were tried, in their order
    step : that of the model
    target : the error that was asked for
    """

    model: Model
    snapshots: Snapshots
    held_out: NDArray[np.bool_]
    steps: tuple[Step, ...]
    step: Step
    target: float

    @property
    def reached(self) -> bool:
        """Whether the error is below the target."""
        return self.step.error <= self.target

    def as_json(self) -> dict[str, Any]:
        """For a model's provenance."""
        return {
            "target_error": self.target,
            "reached": self.reached,
            "step": asdict(self.step),
            "steps": [asdict(step) for step in self.steps],
        }


def accurate_model(
    problem: PosingProblem | InterpolationProblem,
    *,
    target_error: float | None = None,
    most_samples: int | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    surface: EmbeddedSurface | None = None,
    tell: Tell | None = None,
) -> AccurateModel:
    """Solves samples until the model of some meets a target on the others.

    The first stage solves some samples to train on, and a few, more tightly, to judge by. The
    projections of these say which dimension may do, and whether any can; then a model is made, and
    its reduced solutions are compared with them. The ratio of both errors decides the next
    dimension, and where no dimension is enough, half as many samples again are solved. These start
    from the reduced solutions of the best model, if there is one. Time has no say.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
        The reduced energy of its material should be a cubature: where solutions are not unique, as
        with St.Venant-Kirchhoff, no number of samples meets a target.
    target_error : float, default 0.003 for motions, 0.005 for blends
        |x_red - x_full|_M / |x_full - tau|_M of the held-out samples: the median of motions, and
        the mean of blends.
    most_samples : int, optional
        In all, 20 at least. Where the target is not met the best model is returned. Default:
        `usual_most_samples`.
    seed : int, default 0
        Of the samples, see `GrowingSamples`.
    options, threads, progress, checkpoint, executor : as for `solve_snapshots`
    surface : as for `reduce`
    tell : callable(str), optional
        Gets a line for each model that was tried, and why samples are added.

    Returns
    -------
    AccurateModel
        Bitwise the same for the same arguments and any number of threads.

    Raises
    ------
    ValueError
        For a target that is not positive, fewer than 20 samples, or no usable ones.
    Interrupted
        On Ctrl-C, after the finished samples were saved.
    """
    most = usual_most_samples(problem) if most_samples is None else most_samples
    usual = plan_of(problem)
    target_error = usual.target if target_error is None else target_error
    _check(target_error, most)
    plan = _fitting(usual, most)
    say = tell or (lambda line: None)
    growing = GrowingSamples(
        problem,
        most,
        method=plan.sampling,
        seed=seed,
        first=plan.first,
        held_out=plan.held_out,
    )
    steps: list[Step] = []
    best: tuple[Step, Model] | None = None
    for count in _stages(plan, most):
        growing.solve_up_to(
            count,
            options=options,
            threads=threads,
            progress=progress,
            checkpoint=checkpoint,
            executor=executor,
            model=best[1] if best else None,
        )
        # the least: where more dimensions do not help the ratio grows, and says nothing
        ratio = min(map(_ratio, steps), default=plan.first_ratio)
        tries = _Tries(growing, plan, target_error, ratio)
        for dimension in tries.dimensions(last=count == most):
            model = _model(growing, dimension, surface, threads)
            errors = unseen_errors(model, growing.unseen)
            step = Step(
                samples=count,
                dimension=dimension,
                projection=tries.projection(dimension),
                error=plan.typical(errors),
                mean=float(errors.mean()),
                ninth=float(np.quantile(errors, 0.9)),
                unseen=plan.unseen_name,
                typical=plan.typical_name,
            )
            say(str(step))
            steps.append(step)
            tries.add(step)
            if best is None or step.error < best[0].error:
                best = step, model
        if best is not None and best[0].error <= target_error:
            break
        if count < most:
            say(f"no dimension of {count} samples meets {100 * target_error:.2g} %: more samples")
    assert best is not None  # the last stage tries one at least
    return AccurateModel(
        best[1], growing.snapshots, growing.held_out, tuple(steps), best[0], target_error
    )


class _Tries:
    """The dimensions that are tried with the samples of a stage."""

    def __init__(self, growing: GrowingSamples, plan: Plan, target: float, ratio: float) -> None:
        self._projections = np.array([plan.typical(row) for row in growing.projection_errors()])
        most = int(MODES_PER_SOLUTION * growing.trained_solutions)
        self.most = min(plan.most_dimensions, most, len(self._projections) - 1)
        self._target = target
        self._ratio = ratio
        self._steps: list[Step] = []

    def projection(self, dimension: int) -> float:
        """Typical error of the held-out samples' projections."""
        return float(self._projections[dimension])

    def add(self, step: Step) -> None:
        """Takes what the last dimension gave."""
        self._steps.append(step)
        self._ratio = _ratio(step)

    def dimensions(self, *, last: bool) -> Iterator[int]:
        """One after the other, until one meets the target or more of them are of no use."""
        while not self._useless():
            tried = self._steps[-1].dimension if self._steps else 0
            enough = np.flatnonzero(self._projections * self._ratio * MARGIN <= self._target)
            wanted = max(int(enough[0]), ceil(GROWTH * tried), 1) if len(enough) else self.most + 1
            if wanted > self.most:
                # more samples are the cure; at last the best that there is
                if not last or tried == self.most:
                    return
                wanted = self.most
            yield wanted

    def _useless(self) -> bool:
        """Whether the target is met, or the last dimensions did not help."""
        errors = [step.error for step in self._steps]
        met = bool(errors) and errors[-1] <= self._target
        return met or (len(errors) > 1 and errors[-1] > FALL * errors[-2])


def _ratio(step: Step) -> float:
    return step.error / max(step.projection, 1e-12)


def _model(
    growing: GrowingSamples,
    dimension: int,
    surface: EmbeddedSurface | None,
    threads: int | None,
) -> Model:
    trained = growing.trained
    subspace = snapshot_pca(trained, dimension=dimension)
    return reduce(growing.problem, subspace, snapshots=trained, surface=surface, threads=threads)


def _fitting(plan: Plan, most: int) -> Plan:
    """With fewer samples than the first stage has, both parts shrink alike."""
    together = plan.first + plan.held_out
    if most >= together:
        return plan
    held_out = max(FEWEST_HELD_OUT, plan.held_out * most // together)
    return replace(plan, first=most - held_out, held_out=held_out)


def _stages(plan: Plan, most: int) -> list[int]:
    """Numbers of samples."""
    training = float(plan.first)
    stages = [plan.first + plan.held_out]
    while stages[-1] < most:
        training *= MORE_SAMPLES
        stages.append(min(round(training) + plan.held_out, most))
    return stages


def check_target(target_error: float) -> None:
    """ValueError unless a target can be met."""
    if not (np.isfinite(target_error) and target_error > 0):
        raise ValueError(f"the target error is {target_error}, but it must be positive and finite")


def _check(target_error: float, most_samples: int) -> None:
    check_target(target_error)
    if most_samples < FEWEST_SAMPLES:
        raise ValueError(
            f"accurate_model: most_samples is {most_samples}, but at least {FEWEST_SAMPLES} are "
            "needed to train on some and judge by others"
        )
