"""A reduced interpolation model equals the full problem on its subspace, without rigid motions."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import (
    InterpolationModel,
    InterpolationProblem,
    StVK,
    reduce,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.mesh import boundary_surface, mass_inner, mass_norm
from snapspace.reduction import coefficient_count, pose_quartics
from snapspace.subspace import pca, snapshot_pca

from ..shapes import bar_poses, deformed, random_subspace
from ..taylor import observed_order

FloatArray = NDArray[np.float64]
WEIGHTS = np.array([0.5, 0.2, 0.3])


def random_q(model: InterpolationModel, size: float = 1.0, seed: int = 1) -> FloatArray:
    return size * np.random.default_rng(seed).normal(size=model.dimension)


@given(
    weights=st.tuples(*[st.floats(-2, 2)] * 3),
    size=st.floats(1e-3, 3),
    seed=st.integers(0, 1000),
)
@settings(max_examples=30)
def test_the_reduced_energy_is_the_full_one_on_the_subspace(
    blending_model: InterpolationModel, weights: tuple[float, ...], size: float, seed: int
) -> None:
    """Its gradient is the projection of the full gradient."""
    problem, subspace = blending_model.problem, blending_model.subspace
    q, w = random_q(blending_model, size, seed), np.array(weights)
    x = subspace.shape(q)
    value, gradient = blending_model.elastic(w).value_and_gradient(q)
    expected, full_gradient = problem.value_and_gradient(x, w)
    terms = [problem.value_and_gradient(x, e) for e in np.eye(3)]
    scale = np.abs(w) @ [energy for energy, _ in terms]
    assert abs(value - expected) <= 1e-10 * scale + 1e-300  # weights may be denormal
    assert blending_model.value(q, w) == value
    expected_gradient = subspace.basis.T @ full_gradient
    forces = np.abs(w) @ [np.linalg.norm(subspace.basis.T @ force) for _, force in terms]
    assert np.linalg.norm(gradient - expected_gradient) <= 1e-10 * forces + 1e-14


@pytest.mark.parametrize("pose", range(3))
def test_each_pose_has_the_quartic_of_its_energy(
    blending_model: InterpolationModel, pose: int
) -> None:
    q = random_q(blending_model, 0.3)
    x = blending_model.subspace.shape(q)
    energy = blending_model.problem.pose_energy(pose)
    rest = blending_model.problem.pose_shapes[pose]
    value = blending_model.value(q, np.eye(3)[pose])
    assert value == pytest.approx(energy.value_and_gradient(x - rest)[0], rel=1e-11)


def test_taylor_along_the_full_energy(blending_model: InterpolationModel) -> None:
    problem, subspace = blending_model.problem, blending_model.subspace
    q, direction = random_q(blending_model, 0.3), random_q(blending_model, 1.0, 2)
    quartic = blending_model.elastic(WEIGHTS)
    value, gradient = quartic.value_and_gradient(q)
    curvature = direction @ quartic.hessian(q) @ direction

    def remainder(h: float) -> float:
        x = subspace.shape(q + h * direction)
        return problem.value_and_gradient(x, WEIGHTS)[0] - value - h * gradient @ direction

    assert observed_order(remainder) == pytest.approx(2, abs=0.1)
    steps = [0.1, 0.05, 0.025, 0.0125]
    third = observed_order(lambda h: remainder(h) - h**2 / 2 * curvature, steps)
    assert third == pytest.approx(3, abs=0.15)


def rigid_directions(x: FloatArray) -> list[FloatArray]:
    """Three translations, and three infinitesimal rotations about the centroid, (3n,) each."""
    points = x.reshape(-1, 3) - x.reshape(-1, 3).mean(axis=0)
    shifts = [np.tile(axis, len(points)) for axis in np.eye(3)]
    return shifts + [np.cross(axis, points).reshape(-1) for axis in np.eye(3)]


def test_weights_or_coordinates_of_another_model_are_refused(
    blending_model: InterpolationModel,
) -> None:
    with pytest.raises(ValueError, match=r"weights have shape \(2,\), but must be \(3,\)"):
        blending_model.elastic(WEIGHTS[:2])
    with pytest.raises(ValueError, match="InterpolationModel: q must be numbers"):
        blending_model.value("q", WEIGHTS)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["blending_model", "helix_model"])
def test_the_subspace_holds_no_rigid_motion_of_the_mean_shape(
    name: str, request: pytest.FixtureRequest
) -> None:
    """It holds none up to the rounding of bases, which is that of single precision."""
    subspace = request.getfixturevalue(name).subspace
    for direction in rigid_directions(subspace.tau):
        size = mass_norm(subspace.mass, direction)
        cosines = [mass_inner(subspace.mass, u, direction) / size for u in subspace.basis.T]
        assert np.abs(cosines).max() < 3e-7


@pytest.mark.parametrize("name", ["blending_model", "helix_model"])
def test_the_mean_shape_is_a_strict_minimum_of_the_reduced_energy(
    name: str, request: pytest.FixtureRequest
) -> None:
    """Its Hessian, from which the live solver starts, is positive definite."""
    model: InterpolationModel = request.getfixturevalue(name)
    zero = np.zeros(model.dimension)
    quartic = model.elastic(model.problem.domain.center)
    hessian = quartic.hessian(zero)
    curvatures = np.linalg.eigvalsh(hessian)
    assert hessian == pytest.approx(hessian.T, abs=1e-12 * curvatures[-1])
    assert curvatures[0] > 1e-3 * model.problem.material.mu
    _, gradient = quartic.value_and_gradient(zero)
    newton_step = np.linalg.solve(hessian, gradient)
    assert np.linalg.norm(newton_step) < 1e-3 * model.coordinate_scale


def test_a_mean_shape_that_is_a_maximum_is_refused(
    blending_model: InterpolationModel,
) -> None:
    spoilt = -blending_model.blends.coefficients
    with pytest.raises(ValueError, match="at the mean shape is far from positive definite"):
        core.BlendingLoop(blending_model.dimension, spoilt)


@pytest.mark.parametrize("dimension", [1, 5, 12])
def test_leading_is_the_model_of_the_leading_subspace(
    blending_model: InterpolationModel, dimension: int
) -> None:
    leading = blending_model.leading(dimension)
    subspace = blending_model.subspace.leading(dimension)
    direct = reduce(blending_model.problem, subspace)
    assert leading.dimension == dimension
    scale = np.abs(direct.blends.coefficients).max()
    assert leading.blends.coefficients == pytest.approx(
        direct.blends.coefficients, abs=1e-12 * scale
    )
    q = np.random.default_rng(2).normal(size=dimension)
    assert np.array_equal(leading.subspace.shape(q), subspace.shape(q))
    padded = np.concatenate([q, np.zeros(12 - dimension)])
    assert leading.value(q, WEIGHTS) == pytest.approx(blending_model.value(padded, WEIGHTS))
    kept = blending_model.training_coordinates[:, :dimension]
    assert np.array_equal(leading.training_coordinates, kept)
    again = leading.leading(1)
    assert np.array_equal(again.blends.coefficients, blending_model.leading(1).blends.coefficients)


@pytest.mark.parametrize("weights", [WEIGHTS, np.array([1.4, -0.3, -0.1]), np.eye(3)[1]])
def test_the_live_loop_combines_the_quartics(
    blending_model: InterpolationModel, weights: FloatArray
) -> None:
    loop = core.BlendingLoop(blending_model.dimension, blending_model.blends.coefficients)
    quartics = [blending_model.elastic(e) for e in np.eye(3)]
    for others in (np.eye(3)[2], weights):  # the second call replaces the first weights
        loop.set_weights(others)
    q = random_q(blending_model, 0.5)
    value, gradient = loop.value_and_gradient(q)
    terms = [quartic.value_and_gradient(q) for quartic in quartics]
    assert value == pytest.approx(weights @ [term for term, _ in terms], rel=1e-12)
    assert gradient == pytest.approx(weights @ np.array([term for _, term in terms]), rel=1e-11)


def test_the_training_data_are_the_samples_and_the_poses(
    blending_model: InterpolationModel,
) -> None:
    parameters, coordinates = (
        blending_model.training_parameters,
        blending_model.training_coordinates,
    )
    problem, subspace = blending_model.problem, blending_model.subspace
    assert np.array_equal(parameters[:30], sample(problem.domain, 30, seed=1))
    assert np.array_equal(parameters[30:], np.eye(3))
    for q, pose in zip(coordinates[30:], problem.pose_shapes, strict=True):
        assert q == pytest.approx(subspace.coordinates(pose), abs=1e-12)
        missed = mass_norm(subspace.mass, subspace.shape(q) - pose)
        assert missed < 1e-4 * mass_norm(subspace.mass, pose - subspace.tau)
    solved = solve_snapshots(problem, parameters[:3], threads=1)
    for q, shape in zip(coordinates[:3], solved.shapes, strict=True):
        assert np.linalg.norm(q - subspace.coordinates(shape)) < 1e-3 * np.linalg.norm(q)


def test_the_poses_are_in_the_subspace_of_few_samples() -> None:
    """A single sample and three poses span the mean shape's surroundings in four directions."""
    problem = InterpolationProblem(bar_poses(), material=StVK(lam=1.5, mu=0.7))
    snapshots = solve_snapshots(problem, WEIGHTS[None], threads=1)
    subspace = snapshot_pca(snapshots, dimension=4)
    for pose in problem.pose_shapes:
        held = subspace.shape(subspace.coordinates(pose))
        assert held == pytest.approx(pose, abs=1e-9)


def test_coefficients_are_bitwise_the_same_for_any_number_of_threads(
    blending_model: InterpolationModel,
) -> None:
    problem, subspace = blending_model.problem, blending_model.subspace
    for threads in (1, 2, 4, None):
        coefficients = pose_quartics(problem, subspace, threads=threads).coefficients
        assert coefficients.shape == (3, coefficient_count(12))
        assert np.array_equal(coefficients, blending_model.blends.coefficients)


def test_the_surface_is_that_of_the_tets_unless_given(blending_model: InterpolationModel) -> None:
    mesh, subspace = blending_model.problem.mesh, blending_model.subspace.leading(2)
    x = blending_model.subspace.shape(random_q(blending_model, 0.3))
    surface = blending_model.surface
    assert np.array_equal(surface.vertices(x), x.reshape(-1, 3)[mesh.surface_vertices])
    given = boundary_surface(mesh)
    assert reduce(blending_model.problem, subspace, surface=given).surface is given
    assert blending_model.leading(3).surface is surface


def test_scales_grow_with_the_problem(blending_model: InterpolationModel) -> None:
    mesh = blending_model.problem.mesh
    assert blending_model.value_scale == pytest.approx(0.01 * 0.7 * mesh.volume)
    length = 0.1 * mesh.diagonal * np.sqrt(mesh.volume)
    assert blending_model.coordinate_scale == pytest.approx(length)


def test_a_subspace_of_another_shape_is_refused(blending_model: InterpolationModel) -> None:
    """A subspace at the rest shape, as in posing, and one at a shape near the mean are refused."""
    problem = blending_model.problem
    message = "reduce: the subspace is not attached to the problem's reference shape"
    with pytest.raises(ValueError, match=re.escape(message)):
        reduce(problem, random_subspace(problem.mesh, 4))
    nearby = problem.tau + 1e-12
    shapes = deformed(problem.mesh, 0.1)[None]
    with pytest.raises(ValueError, match=re.escape(message)):
        reduce(problem, pca(shapes, nearby, problem.mass(), dimension=1))
