"""growing_models: a first model within seconds, and better ones until one is accurate."""

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
from .model_search import Begins, Model, ModelSearch, SearchOptions, Trial
from .solving import Solving
from .step import Step


@dataclass(frozen=True)
class Growth:
    """One of the models of `growing_models`.

    model : PosingModel or InterpolationModel
    snapshots : what is solved by then, the samples that are held out among them
    held_out : (k,), which these are
    step : errors of the model; None for the first impression, which nothing judges
    seconds : since `growing_models` began
    final : whether no better one follows
    """

    model: Model
    snapshots: Snapshots
    held_out: NDArray[np.bool_]
    step: Step | None
    seconds: float
    final: bool


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
    """The models of `accurate_model` while it looks for the last one.

    The first one is an impression of a few loosely solved samples, whose solves begin there later;
    with `start`, a model of other handles, it is one that is as good as most that start over. All
    others are judged by samples that they are not made of, and each is better than those before
    it.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    target_error, most_samples, budget, seed, start, surface : as for `accurate_model`
    options, threads, progress, executor : as for `solve_snapshots`
    known : Snapshots, optional
        Where the first solves start, as for `solve_snapshots`: samples of an earlier run. Of no use
        with `start`.
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
    search = ModelSearch(
        problem,
        SearchOptions(
            target_error=target_error, most_samples=most_samples, budget=budget, seed=seed
        ),
        Solving(options=options, threads=threads, progress=progress, executor=executor),
        start=start,
        surface=surface,
        begins=begins,
    )
    loose = search.solve_impression(known)
    if loose is not None:
        nothing = np.zeros(len(loose), bool)
        yield Growth(search.impression(loose), loose, nothing, None, search.seconds, False)
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
        trial.model, samples.snapshots, samples.held_out, trial.step, search.seconds, final
    )
