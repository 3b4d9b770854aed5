"""The blended energy over few tets: exact with all tets, derivatives, solver."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    MATERIALS,
    AffineSubspace,
    InterpolationModel,
    InterpolationProblem,
)
from snapspace import _core as core
from snapspace.cubature import BlendedCubature, train
from snapspace.cubature.elastic_states import BlendingStates
from snapspace.cubature.fit_tets import Budget, Fit

from ..shapes import bar_poses
from ..taylor import observed_order

FloatArray = NDArray[np.float64]
D = 7
WEIGHTS = (
    np.array([0.5, 0.2, 0.3]),
    np.array([1.3, -0.2, -0.1]),
    np.array([0.0, 1.0, 0.0]),
)
every_kind = pytest.mark.parametrize("kind", sorted(MATERIALS))


def problem(kind: str) -> InterpolationProblem:
    """The mean shape is the first pose: it need not be a minimum here."""
    poses = bar_poses()
    along = np.linspace(0.0, 1.0, len(poses.tets))
    material = MATERIALS[kind].from_lame(lam=1.0 + along, mu=0.5 + along)
    return InterpolationProblem(poses, material=material, mean_shape=poses.shapes[0])


def subspace(one: InterpolationProblem, dimension: int = D) -> AffineSubspace:
    """Smooth modes: polynomials of the positions."""
    x = one.poses.shapes[0]
    rng = np.random.default_rng(5)
    scaled = (x - x.mean(axis=0)) / np.abs(x - x.mean(axis=0)).max()
    powers = np.stack([scaled**p for p in (1, 2, 3)], axis=2).reshape(len(x), -1)
    modes = np.einsum("np,pad->nad", powers, rng.normal(size=(9, 3, dimension)))
    basis, _ = np.linalg.qr(modes.reshape(-1, dimension))
    return AffineSubspace(one.tau, basis, one.mass(), None)


def every_tet(one: InterpolationProblem, space: AffineSubspace) -> BlendedCubature:
    every = np.arange(len(one.poses.tets), dtype=np.int32)
    return BlendedCubature.of_tets(one, space, every, np.array(one.mesh.volumes))


def some_tets(one: InterpolationProblem, space: AffineSubspace, count: int) -> BlendedCubature:
    rng = np.random.default_rng(2)
    chosen = np.sort(rng.permutation(len(one.poses.tets))[:count]).astype(np.int32)
    return BlendedCubature.of_tets(one, space, chosen, rng.uniform(0.1, 2.0, count))


@every_kind
@pytest.mark.parametrize("weights", WEIGHTS)
@pytest.mark.parametrize("size", [0.0, 0.05])
def test_all_tets_with_their_volumes_are_the_exact_energy(
    kind: str, weights: FloatArray, size: float
) -> None:
    one = problem(kind)
    space = subspace(one)
    elastic = every_tet(one, space)
    q = size * np.random.default_rng(1).normal(size=D)
    value, full = one.value_and_gradient(space.shape(q), weights)
    gradient = space.basis.T @ full
    found, slope = elastic.value_and_gradient(q, weights)
    scale = sum(one.value_and_gradient(space.shape(q), w)[0] for w in np.eye(3))
    assert found == pytest.approx(value, abs=2e-6 * scale)
    assert slope == pytest.approx(gradient, abs=2e-5 * (np.abs(gradient).max() + scale))


@every_kind
@pytest.mark.parametrize("weights", WEIGHTS[:2])
def test_taylor(kind: str, weights: FloatArray) -> None:
    """Remainders of second order: value minus gradient model, gradient minus Hessian model."""
    one = problem(kind)
    elastic = some_tets(one, subspace(one), 33)
    rng = np.random.default_rng(3)
    q, direction = 0.02 * rng.normal(size=D), 0.2 * rng.normal(size=D)
    value, gradient = elastic.value_and_gradient(q, weights)
    hessian = elastic.hessian(q, weights)
    scale = np.abs(hessian).max()
    assert elastic.rough_hessian(q, weights) == pytest.approx(hessian, abs=3e-6 * scale)
    np.testing.assert_array_equal(hessian, hessian.T)

    def first(h: float) -> float:
        moved = elastic.value_and_gradient(q + h * direction, weights)[0]
        return moved - value - h * gradient @ direction

    def second(h: float) -> FloatArray:
        moved = elastic.value_and_gradient(q + h * direction, weights)[1]
        change: FloatArray = moved - gradient - h * hessian @ direction
        return change

    assert observed_order(first) == pytest.approx(2, abs=0.2)
    assert observed_order(second) == pytest.approx(2, abs=0.2)


@every_kind
def test_fewer_coordinates_are_the_first_with_the_rest_zero(kind: str) -> None:
    one = problem(kind)
    elastic = some_tets(one, subspace(one), 17)
    q = 0.02 * np.random.default_rng(4).normal(size=3)
    value, gradient = elastic.leading(3).value_and_gradient(q, WEIGHTS[0])
    padded, slope = elastic.value_and_gradient(np.pad(q, (0, D - 3)), WEIGHTS[0])
    assert value == pytest.approx(padded, rel=1e-6)
    assert gradient == pytest.approx(slope[:3], rel=1e-5, abs=1e-6 * np.abs(slope).max())


def test_another_pose_with_weight_zero_changes_nothing() -> None:
    """The cost of a density that allows collapse does not depend on the number of poses."""
    one = problem("stable-neo-hookean")
    space = subspace(one)
    few = some_tets(one, space, 21)
    corners = np.concatenate([few.corners[:3], 1.1 * few.corners[1:2], few.corners[3:]])
    more = BlendedCubature(few.tets, few.weights, few.rows, few.material, corners)
    assert more.poses == 4
    q = 0.02 * np.random.default_rng(6).normal(size=D)
    value, gradient = few.value_and_gradient(q, WEIGHTS[0])
    again, slope = more.value_and_gradient(q, np.append(WEIGHTS[0], 0.0))
    assert again == pytest.approx(value, rel=1e-13)
    assert slope == pytest.approx(gradient, rel=1e-11, abs=1e-13)


def test_the_loop_minimises_the_same_function(
    blended_cubature_model: InterpolationModel,
) -> None:
    model = blended_cubature_model
    elastic = model.blends
    assert isinstance(elastic, BlendedCubature)
    session = model.session()
    for weights in (WEIGHTS[0], WEIGHTS[2]):
        report = session.blend(weights)
        assert report.converged
        value, gradient = elastic.value_and_gradient(session.q, weights)
        assert report.value == pytest.approx(value, rel=1e-12)
        assert np.linalg.norm(gradient) == pytest.approx(report.gradient_norm, rel=1e-6, abs=1e-12)
        start = elastic.value_and_gradient(np.zeros(model.dimension), weights)
        assert np.linalg.norm(gradient) < 1e-3 * np.linalg.norm(start[1])


def test_newton_and_bfgs_find_the_same_shape(blended_cubature_model: InterpolationModel) -> None:
    shapes = []
    for minimizer in ("newton", "bfgs"):
        session = blended_cubature_model.session(minimizer=minimizer)
        session.blend(WEIGHTS[0])
        shapes.append(session.q)
    scale = np.abs(shapes[0]).max()
    assert shapes[0] == pytest.approx(shapes[1], abs=1e-4 * scale)


def test_reduced_solutions_are_near_the_full_ones(
    blended_cubature_model: InterpolationModel,
) -> None:
    """Trained on 27 of 30 snapshots of a tiny bar; the record has the errors of the other 3."""
    errors = blended_cubature_model.provenance["cubature"]["held_out"]
    assert errors["displacement_median"] < 0.01
    assert errors["energy_median"] < 0.02


@pytest.mark.parametrize("count", [0, 10_000])
def test_bad_tets_are_named(count: int) -> None:
    one = problem("stable-neo-hookean")
    space = subspace(one)
    tets = np.array([count + len(one.poses.tets)], np.int32)
    with pytest.raises(ValueError, match="BlendedCubature: tets must be between 0 and"):
        BlendedCubature.of_tets(one, space, tets, np.ones(1))


def test_bad_arrays_are_named() -> None:
    one = problem("stable-neo-hookean")
    few = some_tets(one, subspace(one), 5)
    with pytest.raises(ValueError, match=r"corners must be \(poses \+ 1, 5, 4, 3\), got"):
        BlendedCubature(few.tets, few.weights, few.rows, few.material, few.corners[:, :4])
    with pytest.raises(ValueError, match=r"the weight of tet .* must be positive"):
        BlendedCubature(few.tets, -few.weights, few.rows, few.material, few.corners)
    with pytest.raises(ValueError, match="weights must have one entry per pose"):
        few.value_and_gradient(np.zeros(D), np.ones(2))
    with pytest.raises(ValueError, match="corners must be"):
        core.BlendedCubature(
            core.TetRows(few.rows), few.weights, few.material.core, np.zeros((2, 4, 12))
        )


@pytest.mark.parametrize("stable_after", [1, 2, 99])
def test_a_saddle_gets_more_tets_until_a_fit_takes_no_more(
    stable_after: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No fit takes more than 60 tets here, as if all others would get negative weights."""
    one = problem("stable-neo-hookean")
    rng = np.random.default_rng(7)
    weights, coordinates = rng.dirichlet(np.ones(3), size=12), 0.02 * rng.normal(size=(12, 3))
    wanted: list[int] = []
    taken: list[int] = []
    fitted = train.fit_tets

    def limited(states: BlendingStates, budget: Budget, **options: Any) -> Fit[BlendingStates]:
        fit = fitted(states, replace(budget, wanted=min(budget.usual, 60)), **options)
        wanted.append(budget.usual)
        taken.append(len(fit.tets))
        return fit

    monkeypatch.setattr(train, "fit_tets", limited)
    monkeypatch.setattr(train, "_is_stable", lambda *_: len(taken) >= stable_after)
    record = train.train_blended_cubature(one, subspace(one, 3), coordinates, weights)[1]
    assert record["tets"] == taken[-1]
    assert wanted == [45, 68, 101][:stable_after]
    assert taken == sorted(taken)
