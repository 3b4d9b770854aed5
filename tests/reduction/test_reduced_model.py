from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from snapspace import ReducedModel, SampleReport, Snapshots, reduce

from ..shapes import irregular_bar, random_subspace


def random_parameters(model: ReducedModel, seed: int = 0) -> np.ndarray:
    half_widths = model.problem.domain.half_widths
    return np.random.default_rng(seed).uniform(-half_widths, half_widths)


@pytest.mark.parametrize("size", [0.1, 3.0])
def test_the_reduced_objective_is_the_full_one_on_the_subspace(
    posing_model: ReducedModel, size: float
) -> None:
    w = random_parameters(posing_model)
    q = size * np.random.default_rng(1).normal(size=20)
    expected, _ = posing_model.problem.value_and_gradient(posing_model.subspace.shape(q), w)
    value = posing_model.value(q, posing_model.problem.offsets(w))
    assert value == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize("dimension", [1, 7, 20])
def test_leading_is_the_model_of_the_leading_subspace(
    posing_model: ReducedModel, dimension: int
) -> None:
    leading = posing_model.leading(dimension)
    subspace = posing_model.subspace.leading(dimension)
    direct = reduce(posing_model.problem, subspace)
    q = np.random.default_rng(2).normal(size=dimension)
    offsets = posing_model.problem.offsets(random_parameters(posing_model))
    assert leading.dimension == dimension
    assert np.array_equal(leading.subspace.shape(q), subspace.shape(q))
    assert leading.value(q, offsets) == pytest.approx(direct.value(q, offsets), rel=1e-12)
    assert leading.training_coordinates.shape == (60, dimension)


def test_training_coordinates_are_those_of_the_snapshots(posing_model: ReducedModel) -> None:
    subspace = posing_model.subspace
    rng = np.random.default_rng(4)
    parameters, coordinates = rng.normal(size=(5, 12)), rng.normal(size=(5, 20))
    shapes = subspace.tau + coordinates @ subspace.basis.T
    reports = [SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, 0)] * 5
    snapshots = Snapshots.from_shapes(posing_model.problem, parameters, shapes, reports)
    model = reduce(posing_model.problem, subspace, snapshots=snapshots)
    assert np.array_equal(model.training_parameters, parameters)
    # a basis in single precision is M-orthonormal up to its rounding
    assert model.training_coordinates == pytest.approx(coordinates, abs=1e-6)


def test_scales_grow_with_the_problem(posing_model: ReducedModel) -> None:
    mesh = posing_model.problem.mesh
    assert posing_model.value_scale == pytest.approx(0.01 * 0.7 * mesh.volume)
    shift = np.tile([0.1 * mesh.diagonal, 0, 0], len(mesh.vertices))
    mass = posing_model.subspace.mass
    norm = np.sqrt(shift[::3] @ mass @ shift[::3])
    assert posing_model.coordinate_scale == pytest.approx(norm)


def test_without_snapshots_nothing_is_recorded(posing_model: ReducedModel) -> None:
    model = reduce(posing_model.problem, posing_model.subspace.leading(3), provenance={"seed": 4})
    assert model.training_parameters.shape == (0, 12)
    assert model.training_coordinates.shape == (0, 3)
    assert model.provenance == {"seed": 4}


def test_a_subspace_of_another_shape_is_refused(posing_model: ReducedModel) -> None:
    message = "reduce: the subspace is not attached to the problem's reference shape"
    with pytest.raises(ValueError, match=re.escape(message)):
        reduce(posing_model.problem, random_subspace(irregular_bar(), 4))
    tau = posing_model.subspace.tau.copy()
    tau[7] += 1e-9
    with pytest.raises(ValueError, match=re.escape(message)):
        reduce(posing_model.problem, replace(posing_model.subspace, tau=tau))


@pytest.mark.parametrize("dimension", [0, -1, 21])
def test_leading_beyond_the_dimension_is_refused(
    posing_model: ReducedModel, dimension: int
) -> None:
    with pytest.raises(ValueError, match=f"dimension {dimension} is not between 1 and 20"):
        posing_model.leading(dimension)
    with pytest.raises(ValueError, match=f"dimension {dimension} is not between 1 and 20"):
        posing_model.handles.leading(dimension)
