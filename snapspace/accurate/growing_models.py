"""growing_models: yields a first model within seconds, then better ones until one is accurate."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import PosingModel
from ..snapshots import Progress, Snapshots, SolverOptions
from .checks import check_search
from .model_maker import Model
from .model_search import ModelSearch
from .search_options import Begins, SearchOptions
from .solving import Solving
from .step import Step
from .trial import Trial


@dataclass(frozen=True, eq=False)
class Growth:
    """One of the models of `growing_models`.

    model : PosingModel or InterpolationModel
    snapshots : the samples solved so far, including the held-out ones
    held_out : (k,), True for the samples that are held out
    step : errors of the model; None for preliminary models, whose errors are not measured
    seconds : time since `growing_models` began
    final : whether this is the last model
    impression : whether this is only an impression, a small model of loosely solved samples
    """

    model: Model
    snapshots: Snapshots
    held_out: NDArray[np.bool_]
    step: Step | None
    seconds: float
    final: bool
    impression: bool = False

    def __repr__(self) -> str:
        what = self.step or "preliminary"
        last = ", final" if self.final else ""
        return f"Growth({what}, {self.seconds:.3g} s{last}, {self.model!r})"


def growing_models(
    problem: PosingProblem | InterpolationProblem,
    *,
    target_error: float | None = None,
    most_samples: int | None = None,
    budget: float | None = None,
    seed: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
    known: Snapshots | None = None,
    begins: Begins | None = None,
    start: PosingModel | None = None,
    surface: EmbeddedSurface | None = None,
) -> Iterator[Growth]:
    """Yields the models that `accurate_model` finds on its way to the last one.

    The first one is an impression: a preliminary model from a few loosely solved samples, from
    which later solves start. With `start`, a model of other handles, a second preliminary model is
    far better, see `accurate_model`; if handles were only removed, it is the first one. All others
    are judged by held-out samples, and each is better than those before it.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    target_error, most_samples, budget, seed, start, surface : as for `accurate_model`
    options, threads, progress, executor : as for `solve_snapshots`
    known : Snapshots, optional
        Where the first solves start, as for `solve_snapshots`: samples of an earlier run. Has no
        effect with `start`.
    begins : callable, optional
        Gets "snapshots", "subspace" or "energy" before each of these parts of the work.

    Yields
    ------
    Growth
        The last one is `final`. Without `known` and `budget` it is bitwise the model of
        `accurate_model`.

    Raises
    ------
    ValueError
        As for `accurate_model`.
    """
    limits = SearchOptions(
        target_error=target_error, most_samples=most_samples, budget=budget, seed=seed
    )
    check_search(problem, limits, options, surface, "growing_models", begins=begins)
    search = ModelSearch(
        problem,
        limits,
        Solving(options=options, threads=threads, progress=progress, executor=executor),
        start=start,
        surface=surface,
        begins=begins,
    )
    loose = search.solve_impression(known)
    if loose is not None:
        held_out = np.zeros(len(loose), bool)
        for model, impression in search.preliminary_models(loose):
            seconds = search.time.spent
            yield Growth(model, loose, held_out, None, seconds, False, impression=impression)
    shown: Trial | None = None
    for trial in search.trials(one_a_stage=True):
        if trial.step.error <= search.target and trial is search.best:
            break
        if shown is None or trial.step.error < shown.step.error:
            shown = trial
            yield _growth(search, trial, final=False)
    yield _growth(search, search.chosen, final=True)


def _growth(search: ModelSearch, trial: Trial, *, final: bool) -> Growth:
    samples = search.samples
    return Growth(
        trial.model, samples.snapshots, samples.held_out, trial.step, search.time.spent, final
    )
