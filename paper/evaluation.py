"""Evaluation: one way to evaluate a reduced energy, with its cost."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace import _core as core
from snapspace.reduction import BlendedCubature
from snapspace.sampling import Domain

from .evaluators import ClusteredEnergy, local_global

FloatArray = NDArray[np.float64]
Model = ss.PosingModel | ss.InterpolationModel
Function = Callable[[FloatArray], Any]

#: Seconds of one measurement, and how many are taken; the shortest counts.
MEASURED, TAKEN = 2e-3, 12
#: Frames on each straight line of a drag, and the seed of its corners.
LINE, SEED = 30, 3
#: Square root of the default tolerance of a session, which bounds its last step (sec. 6.2).
SESSION_STEP = 1e-7**0.5


@dataclass(frozen=True, eq=False)
class Evaluation:
    """A way to evaluate the reduced energy.

    name : name of the curve
    elements : tets, clusters or coefficients that each evaluation visits
    multiply_adds : for value and gradient, without the material's, which are 50 to 200 a tet
    model : whose frames are solved with it
    functions : value and gradient at (d,) in one or more forms, of the same values; the fastest
    counts
    clustered : the energy of clusters of rotations, whose own solver steps are counted
    """

    name: str
    elements: int
    multiply_adds: int
    model: Model
    functions: tuple[Function, ...]
    clustered: ClusteredEnergy | None = None


def value_and_gradient(model: Model, parameters: FloatArray) -> Function:
    """The elastic energy's value and gradient; for blends with these weights."""
    if isinstance(model, ss.PosingModel):
        return model.elastic.value_and_gradient
    if isinstance(model.blends, BlendedCubature):
        blend = core.BlendedCubature(*model.blends.core_arguments)
        blend.set_weights(parameters)
        return blend.value_and_gradient
    return model.blends.at(parameters).value_and_gradient


def microseconds(evaluation: Evaluation, q: FloatArray) -> float:
    """Microseconds of value and gradient at q, called from Python, on one thread."""
    return min(1e6 * _seconds(function, q) for function in evaluation.functions)


def _seconds(function: Function, q: FloatArray) -> float:
    begin = time.perf_counter()
    function(q)
    repeats = max(1, round(MEASURED / max(time.perf_counter() - begin, 1e-9)))
    best = np.inf
    for _ in range(TAKEN if repeats > 1 else 3):
        begin = time.perf_counter()
        for _ in range(repeats):
            function(q)
        best = min(best, (time.perf_counter() - begin) / repeats)
    return float(best)


def warm_frames(model: Model, *, frames: int) -> tuple[float, float]:
    """Median milliseconds of a drag's solves, and their mean number of evaluations."""
    session = model.session()
    first, *others = drag(model.problem.domain, frames)
    session.set_parameters(first)
    reports = [session.set_parameters(parameters) for parameters in others]
    median = float(np.median([1e3 * report.seconds for report in reports]))
    return median, float(np.mean([report.evaluations for report in reports]))


def local_global_steps(model: ss.PosingModel, energy: ClusteredEnergy, *, frames: int) -> float:
    """Mean number of local and global steps of the frames of the same drag.

    They end when a step is as short as those at which a session stops with its default tolerance.
    """
    first, *others = (model.problem.offsets(w) for w in drag(model.problem.domain, frames))
    q = local_global(energy, model.handles, first, np.zeros(model.dimension)).q
    counts = []
    for offsets in others:
        found = local_global(energy, model.handles, offsets, q, tolerance=SESSION_STEP)
        q = found.q
        counts.append(found.steps)
    return float(np.mean(counts))


def drag(domain: Domain, frames: int) -> FloatArray:
    """Parameters (frames + 1, p) along straight lines between random ones of the domain."""
    corners = ss.sample(domain, frames // LINE + 2, seed=SEED)
    places = np.arange(frames + 1) / LINE
    begin = places.astype(int)
    path: FloatArray = (
        corners[begin] + (corners[begin + 1] - corners[begin]) * ((places - begin)[:, None])
    )
    return path
