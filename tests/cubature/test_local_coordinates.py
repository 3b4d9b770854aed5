"""Local coordinates: what they leave out of a cubature, and what they do not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    Cubature,
    InterpolationModel,
    PosingModel,
    PosingProblem,
    StableNeoHookean,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.cubature import LocalRows, local_coordinates
from snapspace.cubature.elastic_states import BlendingStates, PosingStates
from snapspace.cubature.local_coordinates import with_local_coordinates
from snapspace.reduction import solved_coordinates

from ..shapes import bar_problem, irregular_bar

FloatArray = NDArray[np.float64]
BOUNDS = ("OF_MOTIONS", "OF_GRADIENTS", "OF_STRESSES")


@pytest.fixture(scope="module")
def model() -> PosingModel:
    """A long bar in a hundred dimensions, with 800 tets."""
    return long_bar(samples=120, dimension=100)


def long_bar(*, samples: int, dimension: int) -> PosingModel:
    bar = bar_problem(irregular_bar(40, 4, 4))
    problem = PosingProblem(bar.mesh, bar.handles, domain=bar.domain, material=StableNeoHookean())
    snapshots = solve_snapshots(problem, sample(problem.domain, samples, seed=1), threads=1)
    subspace = snapshot_pca(snapshots, dimension=dimension)
    return reduce(problem, subspace, energy="cubature", snapshots=snapshots)


def states_of(model: PosingModel) -> PosingStates:
    coordinates = model.training_coordinates
    return PosingStates(model.problem, model.subspace, coordinates, 2.0 * model.handles.K)


def localised(model: PosingModel, *, threads: int = 1) -> Cubature:
    assert model.cubature is not None
    return with_local_coordinates(model.cubature, states_of(model), fewest=0, threads=threads)


def test_evaluations_read_less_and_frames_hardly_move(model: PosingModel) -> None:
    local = localised(model)
    assert isinstance(local.stored_rows, LocalRows)
    assert local.stored_rows.numbers < 0.8 * model.elastic.rows.size
    motions = 0.9 * model.problem.domain.from_unit(np.random.default_rng(5).random((12, 12)))
    exact = solved_coordinates(model, motions)
    moved = solved_coordinates(replace(model, elastic=local), motions) - exact
    errors = np.linalg.norm(moved, axis=1) / np.linalg.norm(exact, axis=1)
    assert np.median(errors) < 0.002
    assert errors.max() < 0.01


def test_forces_at_the_states_are_kept(model: PosingModel) -> None:
    """The error of a force, as a displacement, is a thousandth of the state's."""
    local = localised(model)
    rest = model.cubature.hessian(np.zeros(model.dimension))
    compliance = np.linalg.inv(rest + 2.0 * model.handles.K)
    for q in model.training_coordinates[::7]:
        difference = local.value_and_gradient(q)[1] - model.cubature.value_and_gradient(q)[1]
        assert np.linalg.norm(compliance @ difference) < 0.003 * np.linalg.norm(q)


def test_the_same_tets_keep_their_weights(model: PosingModel) -> None:
    local, dense = localised(model), model.cubature
    order = np.argsort(local.tets)
    np.testing.assert_array_equal(local.tets[order], dense.tets)
    np.testing.assert_array_equal(local.weights[order], dense.weights)


def test_what_may_be_left_out_decides(model: PosingModel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stricter bounds take more coordinates and leave smaller errors of forces."""
    dense, q = model.cubature, model.training_coordinates[3]
    exact = dense.value_and_gradient(q)[1]
    monkeypatch.setattr("snapspace.cubature.local_rows.MOST", 10.0)
    bounds = {name: getattr(local_coordinates, name) for name in BOUNDS}
    sizes, errors = [], []
    for factor in (10.0, 1.0, 0.1, 1e-3):
        for name, bound in bounds.items():
            monkeypatch.setattr(local_coordinates, name, factor * bound)
        local = localised(model)
        sizes.append(local.stored_rows.numbers)
        errors.append(np.linalg.norm(local.value_and_gradient(q)[1] - exact))
    assert sizes == sorted(sizes)
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-4 * np.linalg.norm(exact)


def test_the_result_does_not_depend_on_the_threads(model: PosingModel) -> None:
    one, many = localised(model), localised(model, threads=3)
    np.testing.assert_array_equal(one.tets, many.tets)
    for name in ("sizes", "rows", "modes"):
        np.testing.assert_array_equal(
            getattr(one.stored_rows, name), getattr(many.stored_rows, name)
        )


def test_small_sums_stay_as_they_are(model: PosingModel) -> None:
    assert with_local_coordinates(model.cubature, states_of(model)) is model.cubature
    assert not isinstance(model.cubature.stored_rows, LocalRows)


def test_large_models_have_local_coordinates() -> None:
    large = long_bar(samples=160, dimension=140).cubature
    assert large.rows.size > local_coordinates.FEWEST_NUMBERS
    assert isinstance(large.stored_rows, LocalRows)


def test_states_without_stresses_say_nothing(model: PosingModel) -> None:
    at_rest = replace(states_of(model), coordinates=np.zeros((3, model.dimension)))
    assert with_local_coordinates(model.cubature, at_rest, fewest=0) is model.cubature


def test_blends_keep_their_frames(
    blended_cubature_model: InterpolationModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Clusters of so small a model save nothing, and are made all the same."""
    monkeypatch.setattr("snapspace.cubature.local_rows.MOST", 10.0)
    for name in BOUNDS:
        monkeypatch.setattr(local_coordinates, name, 5.0 * getattr(local_coordinates, name))
    model = blended_cubature_model
    states = BlendingStates(
        model.problem, model.subspace, model.training_coordinates, model.training_parameters
    )
    local = with_local_coordinates(model.blends, states, fewest=0, threads=1)
    assert local.stored_rows.sizes[:, 1].min() < model.dimension
    weights = model.problem.domain.from_unit(np.random.default_rng(6).random((8, 2)))
    exact = solved_coordinates(model, weights)
    moved = solved_coordinates(replace(model, blends=local), weights) - exact
    assert np.linalg.norm(moved, axis=1).max() < 0.01 * np.linalg.norm(exact, axis=1).max()
