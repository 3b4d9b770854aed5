"""All ways to evaluate the reduced energy of a problem on a subspace."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.reduction import FullBlends, FullEnergy, coefficient_count

from .evaluation import Evaluation, Function, Model, value_and_gradient
from .evaluators import (
    CoarseMesh,
    clustered_energy,
    clustered_model,
    coarse_full_energy,
    coarse_model,
    rotation_clusters,
    with_near_hessian,
)

FloatArray = NDArray[np.float64]

#: Tets of cubatures, for each dimension; the product's default is 8 for posing, 15 for blends.
CUBATURE_TETS = (1, 2, 4, 8, 16)
#: Tets of coarse meshes, and numbers of clusters.
COARSE_TETS = (16_000, 4_000, 2_000, 1_000, 250)
CLUSTERS = (10, 30, 100, 300)
#: Multiply-adds of a tet and mode by rows, and of a vertex and mode there and back.
BY_ROWS, BY_VERTICES = 18, 6


def exact_model(
    problem: ss.PosingProblem | ss.InterpolationProblem, subspace: ss.AffineSubspace
) -> Model | None:
    """The model with the exact quartic; None if the material has none."""
    if problem.material.exact_degree != 4:
        return None
    return ss.reduce(problem, subspace, energy="exact")


def all_tets(model: Model, near: Model, parameters: FloatArray) -> Evaluation:
    """The reference; Newton's method of posing takes the Hessian of the nearest approximation."""
    d, mesh = model.dimension, model.problem.mesh
    adds = BY_VERTICES * len(mesh.vertices) * d * _poses(model)
    functions = (value_and_gradient(model, parameters),)
    if isinstance(model, ss.PosingModel):
        assert isinstance(near, ss.PosingModel) and not isinstance(near.elastic, FullEnergy)
        model = with_near_hessian(model, near.elastic)
    return Evaluation("all tets", len(mesh.elements), adds, model, functions)


def exact(model: Model, parameters: FloatArray) -> Evaluation:
    """The product's exact quartic: each coefficient is visited once."""
    count = coefficient_count(model.dimension)
    functions = (value_and_gradient(model, parameters),)
    return Evaluation("exact quartic", count, count, model, functions)


def cubatures(
    problem: ss.PosingProblem | ss.InterpolationProblem,
    subspace: ss.AffineSubspace,
    snapshots: ss.Snapshots,
    parameters: FloatArray,
) -> Iterator[Evaluation]:
    """The product's cubatures, by their number of tets."""
    d = subspace.dimension
    for tets in CUBATURE_TETS:
        model = ss.reduce(problem, subspace, energy="cubature", tets=tets * d, snapshots=snapshots)
        assert model.cubature is not None
        count = len(model.cubature.tets)
        functions = (value_and_gradient(model, parameters),)
        yield Evaluation("cubature", count, BY_ROWS * count * d, model, functions)


def coarse(
    model: Model, meshes: Sequence[CoarseMesh], parameters: FloatArray
) -> Iterator[Evaluation]:
    """Coarse meshes: summed by the core tet by tet, or as a full mesh, whose tets share vertices.

    Frames are those of the first form, in the core; operations are those of the second, the fewer.
    """
    for one in meshes:
        small = coarse_model(model, one)
        shared = coarse_full_energy(model, one)
        again: Function = (
            shared.at(parameters) if isinstance(shared, FullBlends) else shared
        ).value_and_gradient
        adds = BY_VERTICES * len(one.kept) * model.dimension * _poses(model)
        functions = (value_and_gradient(small, parameters), again)
        yield Evaluation("coarse mesh", len(one.mesh.tets), adds, small, functions)


def clusters(model: ss.PosingModel, snapshots: ss.Snapshots) -> Iterator[Evaluation]:
    """Clusters of rotations, summed by the core.

    The quadratic form of the rest joins that of the handles, where it costs nothing.
    """
    problem, subspace, d = model.problem, model.subspace, model.dimension
    coordinates = subspace.coordinates(snapshots.shapes)
    for wanted in CLUSTERS:
        energy = clustered_energy(
            problem, subspace, rotation_clusters(problem, subspace, coordinates, wanted)
        )
        count = len(energy.clusters.weights)
        functions = (energy.clusters.value_and_gradient,)
        adds, small = BY_ROWS * count * d, clustered_model(model, energy)
        yield Evaluation("rotation clusters", count, adds, small, functions, energy)


def full_model(
    problem: ss.PosingProblem | ss.InterpolationProblem, subspace: ss.AffineSubspace
) -> Model:
    """The model with the energy of all tets, on the subspace that stored models have."""
    return ss.reduce(problem, subspace.in_single_precision(), energy="full")


def _poses(model: Model) -> int:
    return len(model.problem.poses) if isinstance(model, ss.InterpolationModel) else 1
