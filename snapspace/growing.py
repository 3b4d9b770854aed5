"""growing_models: a first model within seconds, and better ones while it is in use."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .interruptible import begin_abandonable
from .mesh import EmbeddedSurface
from .problem import InterpolationProblem, PosingProblem
from .reduction import (
    InterpolationModel,
    PosingModel,
    fewest_snapshots,
    reduce,
    training_tolerance,
)
from .snapshots import Progress, Snapshots, SolverOptions, solve_snapshots
from .subspace import snapshot_pca

FloatArray = NDArray[np.float64]

#: Samples and dimension of the first model. On the Dragon it is within 10 % of the full solutions.
FIRST_SAMPLES, FIRST_DIMENSION = 36, 16
#: Dimension of the second model: its coefficients take an eighth of the time of d = 40.
MIDDLE_DIMENSION = 24


@dataclass(frozen=True)
class Growth:
    """One of the models of `growing_models`.

    model : PosingModel or InterpolationModel
    snapshots : what it is made of; samples of earlier stages come first
    seconds : since `growing_models` began
    final : whether all samples are in it, to the wanted tolerance and dimension
    loose : whether its samples are solved again afterwards, to the wanted tolerance
    """

    model: PosingModel | InterpolationModel
    snapshots: Snapshots
    seconds: float
    final: bool
    loose: bool


def growing_models(
    problem: PosingProblem | InterpolationProblem,
    parameters: ArrayLike,
    *,
    dimension: int = 40,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
    known: Snapshots | None = None,
    begins: Callable[[str], None] | None = None,
    surface: EmbeddedSurface | None = None,
) -> Iterator[Growth]:
    """Models of more and more samples: the first after 36 loosely solved ones, the last after all.

    Stages: 36 loosely solved samples; a third of the samples, where these are 54 or more; all of
    them. What a stage has solved the next one does not solve again, and the loose samples go on
    from where they are.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    parameters : array_like, (k, problem.parameter_count)
        For example from `sample`. Their order matters: the first model is made of the first ones.
    dimension : int, default 40
        d of the last model.
    options, threads, progress, executor, known : as for `solve_snapshots`
    begins : callable, optional
        Gets "snapshots", "subspace" or "energy" before each of these parts of the work.
    surface : as for `reduce`

    Yields
    ------
    Growth
        The last one is what `solve_snapshots`, `snapshot_pca` and `reduce` make of the same
        samples, up to the tolerance and the choice among several minima.

    Raises
    ------
    ValueError
        For bad samples, a dimension that exceeds them, or a surface of another mesh.
    """
    begin = time.perf_counter()
    samples = np.atleast_2d(np.asarray(parameters, np.float64))
    fewest = fewest_snapshots(problem, dimension)
    if len(samples) < fewest:
        raise ValueError(
            f"growing_models: {len(samples)} samples are too few, the energy of "
            f"{problem.material.title} is trained on {fewest}; give more samples"
        )
    wanted = options or SolverOptions(tolerance=training_tolerance(problem, dimension))
    loose = _loosened(wanted, problem)
    done: Snapshots | None = None
    starts = known
    tell = begins or (lambda part: None)
    finish_parts = begin_abandonable(lambda: _make_parts(problem))
    for stage in _stages(len(samples), dimension):
        tell("snapshots")
        first = 0 if done is None else len(done)
        snapshots = solve_snapshots(
            problem,
            samples[first : stage.samples],
            options=loose if stage.loose else wanted,
            threads=threads,
            progress=progress,
            executor=executor,
            known=starts,
        )
        if done is not None:
            snapshots = done.joined(snapshots)
        if not stage.loose:
            done = snapshots
        starts = snapshots if known is None else known.joined(snapshots)
        tell("subspace")
        finish_parts()
        subspace = snapshot_pca(snapshots, dimension=stage.dimension)
        tell("energy")
        model = reduce(problem, subspace, snapshots=snapshots, surface=surface, threads=threads)
        yield Growth(model, snapshots, time.perf_counter() - begin, stage.final, stage.loose)


def _make_parts(problem: PosingProblem | InterpolationProblem) -> None:
    """Makes what every stage needs beside the system, and what can be made without it."""
    _ = problem.mesh.surface
    if isinstance(problem, PosingProblem):  # others have the mass of the mean, a solution
        problem.mass()


def _loosened(
    options: SolverOptions, problem: PosingProblem | InterpolationProblem
) -> SolverOptions:
    """By the energy: loose samples are far from settling, and what counts is how far."""
    tolerance = max(options.tolerance or 0.0, problem.solving.loose_tolerance)
    return replace(options, tolerance=tolerance, settling=None, soft_modes=False)


@dataclass(frozen=True)
class _Stage:
    samples: int
    dimension: int
    loose: bool = False
    final: bool = False


def _stages(samples: int, dimension: int) -> list[_Stage]:
    last = _Stage(samples, dimension, final=True)
    if samples <= FIRST_SAMPLES:
        return [last]
    first = _Stage(FIRST_SAMPLES, min(dimension, FIRST_DIMENSION), loose=True)
    third = samples // 3
    if third < 1.5 * FIRST_SAMPLES:  # hardly better than the first
        return [first, last]
    return [first, _Stage(third, min(dimension, MIDDLE_DIMENSION)), last]
