"""accurate_model: chooses samples and dimension for a target error at unseen parameters."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Checkpoint, Progress, Snapshots, SolverOptions
from .checks import check_search
from .model_maker import Model
from .model_search import ModelSearch
from .search_options import SearchOptions, Tell
from .solving import Solving
from .step import Step

ModelOf = TypeVar("ModelOf", bound=Model)


@dataclass(frozen=True, eq=False)
class AccurateModel(Generic[ModelOf]):
    """A model of motions or blends, and how it was found.

    model : the first model that met the target, or else the one with the least error
    snapshots : all samples, including the held-out ones
    held_out : (k,), True for the samples that were held out
    steps : the models that were tried, in order
    step : the step that made `model`
    target : the requested error
    most_samples : the limit on samples, which may depend on how long they take
    """

    model: ModelOf
    snapshots: Snapshots
    held_out: NDArray[np.bool_]
    steps: tuple[Step, ...]
    step: Step
    target: float
    most_samples: int

    def __repr__(self) -> str:
        missed = "" if self.reached else f", misses its target of {100 * self.target:.2g} %"
        return f"AccurateModel({self.step}{missed}, {self.model!r})"

    @property
    def reached(self) -> bool:
        """Whether the error is below the target."""
        return self.step.error <= self.target


@overload
def accurate_model(
    problem: PosingProblem,
    *,
    target_error: float | None = None,
    most_samples: int | None = None,
    budget: float | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    start: PosingModel | None = None,
    surface: EmbeddedSurface | None = None,
    tell: Tell | None = None,
) -> AccurateModel[PosingModel]: ...
@overload
def accurate_model(
    problem: InterpolationProblem,
    *,
    target_error: float | None = None,
    most_samples: int | None = None,
    budget: float | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    start: None = None,
    surface: EmbeddedSurface | None = None,
    tell: Tell | None = None,
) -> AccurateModel[InterpolationModel]: ...
@overload
def accurate_model(
    problem: PosingProblem | InterpolationProblem,
    *,
    target_error: float | None = None,
    most_samples: int | None = None,
    budget: float | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    start: PosingModel | None = None,
    surface: EmbeddedSurface | None = None,
    tell: Tell | None = None,
) -> AccurateModel[Any]: ...
def accurate_model(
    problem: PosingProblem | InterpolationProblem,
    *,
    target_error: float | None = None,
    most_samples: int | None = None,
    budget: float | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | None = None,
    executor: Executor | None = None,
    start: PosingModel | None = None,
    surface: EmbeddedSurface | None = None,
    tell: Tell | None = None,
) -> AccurateModel[Any]:
    """Solves samples until a model trained on some of them meets a target error on the others.

    The first stage solves some samples to train on, and, more tightly, a few that are held out to
    judge models. The projection errors of the held-out samples show which dimension may be enough,
    if any. Then a model is made, and its reduced solutions are compared with the held-out samples.
    The ratio of the two errors decides the next dimension. If no dimension is enough, half as many
    samples again are solved, starting from the reduced solutions of the best model, if there is
    one. If motions miss the target with all samples, and these allow fewer than 320 dimensions, the
    last model combines parts of samples, see `widen`; bodies of more than 75,000 vertices gain
    nothing from that. Without a budget, the result does not depend on time.

    Bodies that are soft between their handles take many evaluations. If the first 32 motions of a
    solid take more than 110 each on average, a model predicts the others. They start from its
    solutions, with its Hessians in the seed of the solver, and have a looser tolerance. Held-out
    samples are not predicted. There may then be more samples, see `predicted_most_samples`.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
        The reduced energy of its material should be a cubature: where solutions are not unique, as
        with St.Venant-Kirchhoff, no number of samples meets a target.
    target_error : float, default 0.003 for motions, 0.005 for blends
        |x_red - x_full|_M / |x_full - tau|_M of the held-out samples: the median for motions, and
        the mean for blends.
    most_samples : int, optional
        Largest number of samples in all, at least 20. If the target is not met, the best model is
        returned. Default: `usual_most_samples`, or `predicted_most_samples` where models predict.
    budget : float, optional
        Time limit in seconds. The first stage is always solved; further samples are not if they
        would probably exceed the limit. With a budget, the result depends on the speed of the
        machine. Default: none; the default of `most_samples` limits large meshes to about a minute
        on two cores.
    seed : int, default 0
        Seed of the samples, see `GrowingSamples`.
    options, threads, progress, checkpoint, executor : as for `solve_snapshots`
    start : PosingModel, optional
        A model of the same mesh with other handles, just made or loaded: handles may have been
        added, removed or moved. Bounds and material may differ as well. The first new model is then
        made from its shapes, and from loosely solved shapes that start from its predictions for the
        new handles. The new model has up to 1.6 times the error of one made from scratch, after 0.3
        to 0.8 of the time. Unless it meets the target, samples are solved starting
        from its solutions, and later bases include the old shapes.
        If handles were only removed, the first new model is the old one without them, at once.
        Unless it meets the target, others are made as without `start`, since the old shapes would
        use up dimensions.
    surface : as for `reduce`
    tell : callable(str), optional
        Gets a line for each model that was tried, and the reason when samples are added.

    Returns
    -------
    AccurateModel
        Bitwise the same for the same arguments and any number of threads, unless there is a budget.

    Raises
    ------
    ValueError
        For something other than a problem, a target that is not between 0 and 1, a budget that is
        not positive, fewer than 20 samples, or no usable ones. Also for a `start` of another mesh
        or without training shapes, for a surface of another mesh, and for an argument of another
        type.
    Interrupted
        On Ctrl-C, after the finished samples have been saved.
    """
    who = "accurate_model"
    limits = SearchOptions(
        target_error=target_error, most_samples=most_samples, budget=budget, seed=seed
    )
    check_search(problem, limits, options, surface, who, checkpoint=checkpoint, tell=tell)
    search = ModelSearch(
        problem,
        limits,
        Solving(
            options=options,
            threads=threads,
            progress=progress,
            checkpoint=checkpoint,
            executor=executor,
        ),
        start=start,
        surface=surface,
        tell=tell,
    )
    search.begin()
    for _ in search.trials():
        pass
    chosen, samples = search.chosen, search.samples
    return AccurateModel(
        model=chosen.model,
        snapshots=samples.snapshots,
        held_out=samples.held_out,
        steps=tuple(search.steps),
        step=chosen.step,
        target=search.target,
        most_samples=search.most,
    )
