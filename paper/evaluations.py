"""Evaluations: the error that each evaluation of a reduced energy adds, against its cost.

The paper names the evaluations (sec. 2 and 6.1) and compares none. Here all have the same
subspace, and handles are exact. The error added is the distance of the reduced minimiser with the
evaluation from that with all tets, over the displacement of the full solution. Both are found by
Newton's method from the projection of the full solution, at unseen parameters. With
St.Venant-Kirchhoff a few solutions are in another minimum, which means show and medians do not.

All evaluations run in the compiled core on one thread, called from Python: a coarse mesh is summed
there like a cubature or as a full mesh, whichever is faster, and clusters are a cubature plus a
quadratic form. Cubatures are trained on the samples of the subspace.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.mesh import mass_norms, solid_of

from . import evaluation_methods as methods
from .cached import training, unseen
from .cases import MATERIALS, Case, read
from .evaluation import Evaluation, Model, local_global_steps, microseconds, warm_frames
from .evaluation_charts import draw
from .evaluation_orderings import faults
from .evaluators import CoarseMesh, coarse_meshes
from .minimisers import coordinates_of_minimisers
from .result import Result

__all__ = ["draw", "faults", "run"]

FloatArray = NDArray[np.float64]

UNSEEN = 10
#: Solves end when they are far nearer to a minimum than the errors that are measured.
TOLERANCE = 1e-12
#: Rotations are clustered for it.
ARAP = "arap"


@dataclass(frozen=True)
class Group:
    """A problem: its name, samples, those with ARAP (none for blends), and dimensions.

    ARAP, whose evaluations take the longest, has the first dimension only.
    """

    name: str
    samples: int
    arap_samples: int
    dimensions: tuple[int, ...]


GROUPS = (
    Group("dragon", 300, 60, (40, 20)),
    Group("elephant", 200, 60, (40,)),
    Group("helix", 30, 0, (20,)),
)
#: For generated shapes.
QUICK = (Group("dragon", 60, 60, (20,)), Group("helix", 30, 0, (20,)))


def run(*, quick: bool = False) -> Result:
    """All problems, for the paper's material, stable neo-Hookean and, posing, ARAP."""
    result = Result("evaluations", "Error added by evaluations of the reduced energy, and its cost")
    for group in QUICK if quick else GROUPS:
        meshes: list[CoarseMesh] = []
        for kind in (*MATERIALS, ARAP) if group.arap_samples else MATERIALS:
            case = read(group.name, kind, quick=quick)
            meshes = meshes or _coarsened(case.problem)
            samples, dimensions = group.samples, group.dimensions
            if kind == ARAP:
                samples, dimensions = group.arap_samples, dimensions[:1]
            _add(result, case, samples, dimensions, meshes, frames=15 if quick else 30)
    return result


def _coarsened(problem: ss.PosingProblem | ss.InterpolationProblem) -> list[CoarseMesh]:
    sizes = [size for size in methods.COARSE_TETS if size < len(problem.mesh.elements)]
    poses = problem.poses.shapes if isinstance(problem, ss.InterpolationProblem) else None
    return list(coarse_meshes(solid_of(problem.mesh, who="evaluations"), sizes, poses=poses))


def _add(
    result: Result,
    case: Case,
    samples: int,
    dimensions: tuple[int, ...],
    meshes: list[CoarseMesh],
    *,
    frames: int,
) -> None:
    problem = case.problem
    snapshots, reference = training(problem, samples), unseen(problem, UNSEEN)
    largest = ss.snapshot_pca(snapshots, dimension=max(dimensions))
    quartic = methods.exact_model(problem, largest)
    displacements = mass_norms(largest.mass, reference.shapes - largest.tau)
    for d in dimensions:
        whole = methods.full_model(problem, largest.leading(d))
        polynomial = None if quartic is None else quartic.leading(d)
        found = list(_evaluations(whole, polynomial, snapshots, reference, meshes))
        wanted = _minimisers(found[-1].model, reference)
        for one in found[:-1]:
            errors = _distances(one.model, reference, wanted) / displacements
            steps = _steps(one, whole, frames)
            result.add(shape=case.shape, **_row(one, errors, wanted[0], steps, frames=frames))
        none = np.zeros(len(wanted))
        result.add(shape=case.shape, **_row(found[-1], none, wanted[0], None, frames=frames // 10))


def _row(
    one: Evaluation, errors: FloatArray, q: FloatArray, steps: float | None, *, frames: int
) -> dict[str, Any]:
    """Error and cost of an evaluation; it is timed at q."""
    milliseconds, evaluations = warm_frames(one.model, frames=frames)
    return {
        "material": one.model.problem.material.kind,
        "d": one.model.dimension,
        "evaluation": one.name,
        "elements": one.elements,
        "multiply-adds": one.multiply_adds,
        "mean": _short(errors.mean()),
        "median": _short(np.median(errors)),
        "us": _short(microseconds(one, q)),
        "frame ms": _short(milliseconds),
        "evaluations": _short(evaluations),
        "local/global steps": steps,
    }


def _evaluations(
    whole: Model,
    polynomial: Model | None,
    snapshots: ss.Snapshots,
    reference: ss.Snapshots,
    meshes: list[CoarseMesh],
) -> Iterator[Evaluation]:
    """All evaluations of a problem on a subspace, all tets at the end."""
    problem, parameters = whole.problem, reference.parameters[0]
    near: Model | None = polynomial
    if polynomial is not None:
        yield methods.exact(polynomial, parameters)
    for one in methods.cubatures(problem, whole.subspace, snapshots, parameters):
        yield one
        near = polynomial or one.model
    yield from methods.coarse(whole, meshes, parameters)
    if problem.material.kind == ARAP:
        assert isinstance(whole, ss.PosingModel)
        yield from methods.clusters(whole, snapshots)
    assert near is not None
    yield methods.all_tets(whole, near, parameters)


def _distances(model: Model, reference: ss.Snapshots, wanted: FloatArray) -> FloatArray:
    """M-norms (k,) between a model's minimisers and others; blends are registered, as poses are."""
    problem, subspace = model.problem, model.subspace
    pairs = zip(_minimisers(model, reference), wanted, strict=True)
    shapes = [(subspace.shape(found), subspace.shape(q)) for found, q in pairs]
    away = np.array([problem.aligned(found, other) - other for found, other in shapes])
    return mass_norms(subspace.mass, away)


def _steps(one: Evaluation, whole: Model, frames: int) -> float | None:
    """Local and global steps of a frame with clusters; None for other evaluations."""
    if one.clustered is None:
        return None
    assert isinstance(whole, ss.PosingModel)
    return _short(local_global_steps(whole, one.clustered, frames=frames))


def _minimisers(model: Model, reference: ss.Snapshots) -> FloatArray:
    found = coordinates_of_minimisers(model, reference, tolerance=TOLERANCE)
    return np.array(list(found))


def _short(value: float) -> float:
    """Four significant digits."""
    return float(f"{value:.4g}")
