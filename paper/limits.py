"""The limits that the paper names (sec. 8.1), measured.

Symmetry: errors of the PCA of k samples, of these with their mirror images, and of 2 k samples, at
equal dimension. Other handles: errors of a subspace of other handles, of the same with the linear
responses of the new ones, and of a new one. Sampling in parallel: seconds by threads and processes.
Errors are those of projections of unseen solutions, the least that the subspace allows.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

import snapspace as ss
from snapspace.mesh import solid_of

from .cached import training, unseen
from .cases import Case, read
from .limits_orderings import limits_in_order
from .minimisers import projection_errors
from .orderings import Rows
from .result import Result
from .rivals.linear_response import linear_responses
from .symmetry import SYMMETRIC, mirror_of, mirrored, partners
from .timing import timed

KIND = "stable-neo-hookean"
#: Cases of symmetric bodies, of a handle that is added, and the samples of parallel sampling.
SYMMETRIC_CASES, OTHER_CASES, PARALLEL = ("dog_head", "spot"), ("armadillo",), 32
QUICK_SYMMETRIC, QUICK_PARALLEL = ("dragon", "armadillo"), 16
SAMPLES, DIMENSION, UNSEEN = 60, 40, 10
QUICK_SAMPLES, QUICK_DIMENSION = 24, 16


def run(*, quick: bool = False) -> Result:
    """All limits in stable neo-Hookean."""
    result = Result("limits", "Limits: symmetry, other handles, sampling in parallel")
    count, dimension = (QUICK_SAMPLES, QUICK_DIMENSION) if quick else (SAMPLES, DIMENSION)
    for name in QUICK_SYMMETRIC if quick else SYMMETRIC_CASES:
        for row in _symmetry(read(name, KIND, quick=quick), count, dimension):
            result.add(**row)
    for name in OTHER_CASES:
        for row in _other_handles(read(name, KIND, quick=quick), count, dimension):
            result.add(**row)
    for row in _parallel(read("dragon", KIND, quick=quick), QUICK_PARALLEL if quick else PARALLEL):
        result.add(**row)
    return result


faults = limits_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Draws nothing: a table needs no picture."""


def _row(limit: str, case: Case, variant: str, **figures: Any) -> dict[str, Any]:
    row = {"limit": limit, "shape": case.shape, "variant": variant, "solved": None, "d": None}
    row |= {"error": None, "asymmetry": None, "seconds": None}
    return row | figures


def _symmetry(case: Case, count: int, dimension: int) -> Iterator[dict[str, Any]]:
    problem = case.problem
    assert isinstance(problem, ss.PosingProblem)
    mirror = mirror_of(solid_of(problem.mesh, who="limits"))
    if mirror.asymmetry > SYMMETRIC or partners(problem, mirror) is None:
        raise ValueError(f"limits: {case.shape} is not symmetric: {mirror.asymmetry:.2g}")
    reference = unseen(problem, UNSEEN)
    few, many = training(problem, count).shapes, training(problem, 2 * count).shapes
    images = mirrored(problem, few, mirror)
    tau, mass = problem.tau, problem.mass()
    variants = {
        "samples": (few, count),
        "samples and mirror images": (np.vstack([few, images]), count),
        "twice the samples": (many, 2 * count),
    }
    for variant, (shapes, solved) in variants.items():
        subspace = ss.pca(shapes, tau, mass, dimension=dimension)
        error = float(projection_errors(subspace, reference).mean())
        yield _row(
            "symmetry",
            case,
            variant,
            solved=solved,
            d=dimension,
            error=error,
            asymmetry=mirror.asymmetry,
        )


def _other_handles(case: Case, count: int, dimension: int) -> Iterator[dict[str, Any]]:
    """Subspaces for a body whose last handle is new."""
    problem = case.problem
    assert isinstance(problem, ss.PosingProblem)
    before = problem.with_handles(problem.handles.without(problem.handles.names[-1]))
    old = ss.snapshot_pca(training(before, count), dimension=dimension)
    reference = unseen(problem, UNSEEN)
    responses = linear_responses(problem)
    both = ss.affine_subspace(np.hstack([old.basis, responses]), problem, nested=False)
    new = ss.snapshot_pca(training(problem, count), dimension=dimension)
    for variant, subspace, solved in (
        ("old handles", old, 0),
        ("old handles and linear responses", both, 0),
        ("new samples", new, count),
    ):
        error = float(projection_errors(subspace, reference).mean())
        yield _row("other handles", case, variant, solved=solved, d=subspace.dimension, error=error)


def _parallel(case: Case, count: int) -> Iterator[dict[str, Any]]:
    problem = case.problem
    parameters = ss.sample(problem.domain, count, method="sobol")
    ss.solve_snapshots(problem, parameters[:1])  # factors are made once, for all
    for threads in (1, 2):
        solve = partial(ss.solve_snapshots, problem, parameters, threads=threads)
        _, seconds = timed(solve)
        variant = f"{threads} thread{'s' if threads > 1 else ''}"
        yield _row("parallel", case, variant, solved=count, seconds=seconds)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        _, seconds = timed(partial(ss.solve_snapshots, problem, parameters, executor=pool))
    yield _row("parallel", case, "2 processes", solved=count, seconds=seconds)
