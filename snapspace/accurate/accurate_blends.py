"""accurate_blends: as many samples and dimensions as an error of unseen blends asks for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem
from ..reduction import InterpolationModel, reduce
from ..snapshots import Checkpoint, Progress, Snapshots, SolverOptions
from ..subspace import snapshot_pca
from ..validation import unseen_errors
from .growing_samples import GrowingSamples

FloatArray = NDArray[np.float64]
Tell = Callable[[str], None]

#: The mean error of unseen blends that is good enough.
TARGET_ERROR = 0.005
#: Samples of the first stage, and the growth from stage to stage.
FIRST_SAMPLES, MORE_SAMPLES = 40, 1.5
#: The most samples by default: 640, but no more than this many vertices in all where 160 are that
#: many. They take as long as half a minute on small meshes, and a minute on large ones.
MOST_SAMPLES, FEWER_SAMPLES, MOST_VERTICES = 640, 160, 2_000_000
#: The most dimensions: a frame of a drag takes up to a millisecond.
MOST_DIMENSIONS = 200
#: Modes for each solution that they come from: the last ones fit these alone.
MODES_PER_SOLUTION = 0.8
#: Errors of reduced solutions over those of projections, before it is measured: they are 2 to 14
#: on generated and real poses. Too low a one costs models that miss the target.
FIRST_RATIO = 8.0
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
    projection : mean error of the held-out samples' projections
    error : of their reduced solutions
    """

    samples: int
    dimension: int
    projection: float
    error: float

    def __str__(self) -> str:
        return (
            f"{self.samples} samples, d = {self.dimension}: error of unseen blends "
            f"{100 * self.error:.2g} %, of their projections {100 * self.projection:.2g} %"
        )


@dataclass(frozen=True)
class AccurateBlends:
    """A model of blended poses, and how it came about.

    model : the first that met the target, or else that with the least error
    snapshots : all samples; the last of them were held out
    steps : the models that were tried, in their order
    step : that of the model
    target : the mean error that was asked for
    """

    model: InterpolationModel
    snapshots: Snapshots
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
            "step": vars(self.step),
            "steps": [vars(step) for step in self.steps],
        }


def accurate_blends(
    problem: InterpolationProblem,
    *,
    target_error: float = TARGET_ERROR,
    most_samples: int | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    surface: EmbeddedSurface | None = None,
    tell: Tell | None = None,
) -> AccurateBlends:
    """Solves samples until the model of some meets a target on the others.

    Stages of 40, 60, 90 and more samples, each half as many again: the last ones of each are held
    out. Their projections say which dimension may do, and whether any can; then a model is made,
    and its reduced solutions are compared with them. The ratio of both errors decides the next
    dimension, and where no dimension is enough, the next stage follows. Its samples start from the
    reduced solutions of the best model, if there is one. Time has no say.

    Parameters
    ----------
    problem : InterpolationProblem
    target_error : float, default 0.005
        Mean of |x_red - x_full|_M / |x_full - tau|_M over the held-out samples.
    most_samples : int, optional
        The last stage, 20 at least. Where the target is not met the best model is returned.
        Default: `usual_most_samples`.
    seed : int, default 0
        Of the samples, see `GrowingSamples`.
    options, threads, progress, checkpoint, executor : as for `solve_snapshots`
    surface : as for `reduce`
    tell : callable(str), optional
        Gets a line for each model that was tried, and why samples are added.

    Returns
    -------
    AccurateBlends
        Bitwise the same for the same arguments and any number of threads.

    Raises
    ------
    ValueError
        For a target that is not positive, fewer than 20 samples, or no usable ones.
    Interrupted
        On Ctrl-C, after the finished samples were saved.
    """
    if most_samples is None:
        most_samples = usual_most_samples(problem)
    _check(target_error, most_samples)
    say = tell or (lambda line: None)
    growing = GrowingSamples(problem, most_samples, seed=seed)
    steps: list[Step] = []
    best: tuple[Step, InterpolationModel] | None = None
    for count in _stages(most_samples):
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
        ratio = min(map(_ratio, steps), default=FIRST_RATIO)
        tries = _Tries(growing, target_error, ratio)
        for dimension in tries.dimensions(last=count == most_samples):
            model = _model(growing, dimension, surface, threads)
            error = float(unseen_errors(model, growing.unseen).mean())
            step = Step(count, dimension, tries.projection(dimension), error)
            say(str(step))
            steps.append(step)
            tries.add(step)
            if best is None or error < best[0].error:
                best = step, model
        if best is not None and best[0].error <= target_error:
            break
        if count < most_samples:
            say(f"no dimension of {count} samples meets {100 * target_error:.2g} %: more samples")
    assert best is not None  # the last stage tries one at least
    return AccurateBlends(best[1], growing.snapshots, tuple(steps), best[0], target_error)


class _Tries:
    """The dimensions that are tried with the samples of a stage."""

    def __init__(self, growing: GrowingSamples, target: float, ratio: float) -> None:
        self._projections = growing.projection_errors().mean(axis=1)
        most = int(MODES_PER_SOLUTION * growing.trained_solutions)
        self.most = min(MOST_DIMENSIONS, most, len(self._projections) - 1)
        self._target = target
        self._ratio = ratio
        self._steps: list[Step] = []

    def projection(self, dimension: int) -> float:
        """Mean error of the held-out samples' projections."""
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
) -> InterpolationModel:
    trained = growing.trained
    subspace = snapshot_pca(trained, dimension=dimension)
    return reduce(growing.problem, subspace, snapshots=trained, surface=surface, threads=threads)


def _stages(most: int) -> list[int]:
    stages = [FIRST_SAMPLES]
    while stages[-1] < most:
        stages.append(round(MORE_SAMPLES * stages[-1]))
    return [min(stage, most) for stage in stages]


def usual_most_samples(problem: InterpolationProblem) -> int:
    """The most samples by default: 640, on large meshes fewer, but 160 at least."""
    fitting = MOST_VERTICES // len(problem.mesh.vertices)
    return min(MOST_SAMPLES, max(FEWER_SAMPLES, fitting))


def check_target(target_error: float) -> None:
    """ValueError unless a target can be met."""
    if not (np.isfinite(target_error) and target_error > 0):
        raise ValueError(f"the target error is {target_error}, but it must be positive and finite")


def _check(target_error: float, most_samples: int) -> None:
    check_target(target_error)
    if most_samples < FIRST_SAMPLES // 2:
        raise ValueError(
            f"accurate_blends: most_samples is {most_samples}, but at least "
            f"{FIRST_SAMPLES // 2} are needed to train on some and judge by others"
        )
