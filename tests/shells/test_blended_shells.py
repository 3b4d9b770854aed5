"""Blends of shells: their energy, its collapse, and reduced models."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import (
    InterpolationModel,
    InterpolationProblem,
    Material,
    ShellMesh,
    ShellPoses,
    SolverOptions,
    StableNeoHookean,
    StVK,
    load,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.cubature import BlendedCubature
from snapspace.mesh import mass_norm

from ..taylor import observed_order
from .sheets import hinge_vertices, irregular, rolled, sheet

FloatArray = NDArray[np.float64]

MATERIALS: list[Material] = [StVK(lam=1.3, mu=0.7), StableNeoHookean(lam=1.3, mu=0.7)]
each = pytest.mark.parametrize("material", MATERIALS, ids=lambda m: m.kind)
SQUARE = irregular(25, thickness=0.04)
WEIGHTS = np.array([0.2, 0.5, 0.3])


def poses() -> list[ShellMesh]:
    """A sheet: flat, rolled up and turned, and stretched and bent the other way."""
    turn = Rotation.from_rotvec([0.3, 1.0, -0.5]).as_matrix()
    shapes = [
        SQUARE.vertices,
        rolled(SQUARE.vertices, 2.0, 0.4).reshape(-1, 3) @ turn.T,
        rolled(SQUARE.vertices * [1.2, 0.9, 1.0], -1.0, 1.3).reshape(-1, 3),
    ]
    return [ShellMesh(shape, SQUARE.triangles, thickness=SQUARE.thickness) for shape in shapes]


def problem(material: Material) -> InterpolationProblem:
    return InterpolationProblem(poses(), material=material)


def bumpy_mean(one: InterpolationProblem, size: float) -> FloatArray:
    noise = np.random.default_rng(0).normal(size=one.tau.size)
    return one.tau + size * noise


@each
@pytest.mark.parametrize("weights", [*np.eye(3), WEIGHTS, np.array([1.3, -0.1, -0.2])])
def test_the_blend_is_the_weighted_sum_of_the_poses_energies(
    material: Material, weights: FloatArray
) -> None:
    """It is so although it collapses to a few numbers per element."""
    one = problem(material)
    x = bumpy_mean(one, 0.03)
    value, gradient = one.value_and_gradient(x, weights)
    parts = [one.pose_energy(k).value_and_gradient(x - one.pose_shapes[k]) for k in range(3)]
    scale = sum(abs(w * part[0]) for w, part in zip(weights, parts, strict=True))
    assert value == pytest.approx(
        sum(w * part[0] for w, part in zip(weights, parts, strict=True)), abs=1e-11 * scale
    )
    expected = sum(w * part[1] for w, part in zip(weights, parts, strict=True))
    np.testing.assert_allclose(gradient, expected, atol=1e-10 * np.abs(expected).max())


@each
def test_many_poses_cost_sums_and_are_the_same(material: Material) -> None:
    """More than eight poses keep the sums of their numbers; fewer sum them in each evaluation."""
    few = problem(material)
    many = InterpolationProblem([*poses(), *poses(), *poses()], material=material)
    x = few.poses.shapes[0].reshape(-1) + 0.02 * np.random.default_rng(1).normal(size=few.base.size)
    value, gradient = few.system.value_and_gradient(x - few.base, WEIGHTS)
    again, slope = many.system.value_and_gradient(x - many.base, np.tile(WEIGHTS, 3) / 3)
    assert again == pytest.approx(value, rel=1e-11)
    np.testing.assert_allclose(slope, gradient, atol=1e-11 * np.abs(gradient).max())


@each
def test_one_hot_weights_have_the_pose_as_minimum(material: Material) -> None:
    one = problem(material)
    for pose, weights in zip(one.pose_shapes, np.eye(3), strict=True):
        value, gradient = one.value_and_gradient(pose, weights)
        assert abs(value) < 1e-16 and np.abs(gradient).max() < 1e-12


def test_halfway_a_hinge_has_the_mean_of_its_angles() -> None:
    """Both triangles keep their shapes, since nothing opposes it."""
    angles = (0.5, -1.1)
    triangles = np.array([[0, 1, 2], [1, 0, 3]])
    meshes = [ShellMesh(hinge_vertices(angle), triangles, thickness=0.1) for angle in angles]
    one = InterpolationProblem(meshes, material=StableNeoHookean())
    halfway = one.mean_shape.reshape(-1, 3)
    normals = np.cross(
        halfway[triangles[:, 1]] - halfway[triangles[:, 0]],
        halfway[triangles[:, 2]] - halfway[triangles[:, 0]],
    )
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    cosine = normals[0] @ normals[1]
    assert np.arccos(cosine) == pytest.approx(0.3, abs=5e-3)


def test_a_hinge_that_is_folded_in_one_pose_is_blended() -> None:
    """Its bending does not take the digits of the other poses, and is no stiffer than theirs."""
    triangles = np.array([[0, 1, 2], [1, 0, 3]])
    meshes = [ShellMesh(hinge_vertices(angle), triangles, thickness=0.1) for angle in (np.pi, 0.2)]
    one = InterpolationProblem(meshes, material=StableNeoHookean())
    x = one.pose_shapes[1]
    value, gradient = one.value_and_gradient(x, np.array([0.0, 1.0]))
    assert abs(value) < 1e-15 and np.abs(gradient).max() < 1e-11
    assert one.value_and_gradient(x, np.array([0.5, 0.5]))[0] < 1.0


@pytest.fixture(scope="module")
def model() -> InterpolationModel:
    flat = sheet(10, 6, thickness=0.1)
    shapes = [flat.vertices, rolled(flat.vertices, 1.0, 0.2), rolled(flat.vertices, -1.2, 1.2)]
    one = InterpolationProblem(
        [ShellMesh(shape, flat.triangles, thickness=0.1) for shape in shapes],
        material=StableNeoHookean(),
    )
    weights = sample(one.domain, 24, seed=1)
    snapshots = solve_snapshots(one, weights, threads=1)
    assert snapshots.converged.all()
    subspace = snapshot_pca(snapshots, dimension=12)
    return reduce(one, subspace, snapshots=snapshots, threads=1)


def test_the_cubature_of_all_elements_is_the_energy(model: InterpolationModel) -> None:
    one, subspace = model.problem, model.subspace
    every = np.arange(len(one.mesh.elements), dtype=np.int32)
    whole = BlendedCubature.of_tets(one, subspace, every, one.mesh.measures)
    rng = np.random.default_rng(0)
    q = 0.1 * model.coordinate_scale * rng.normal(size=model.dimension)
    value, gradient = one.value_and_gradient(subspace.shape(q), WEIGHTS)
    reduced, slope = whole.value_and_gradient(q, WEIGHTS)
    assert reduced == pytest.approx(value, rel=1e-4)
    exact = subspace.basis.T @ gradient
    np.testing.assert_allclose(slope, exact, atol=1e-4 * np.abs(exact).max())


@each
def test_the_cubature_is_consistent(material: Material) -> None:
    one = problem(material)
    rng = np.random.default_rng(2)
    snapshots = solve_snapshots(
        one, sample(one.domain, 6, seed=2), options=SolverOptions(tolerance=1e-6), threads=1
    )
    subspace = snapshot_pca(snapshots, dimension=5)
    elements = np.arange(0, len(one.mesh.elements), 3, dtype=np.int32)
    cubature = BlendedCubature.of_tets(one, subspace, elements, one.mesh.measures[elements])
    q, d = 0.02 * rng.normal(size=5), 0.004 * rng.normal(size=5)
    value, gradient = cubature.value_and_gradient(q, WEIGHTS)
    product = cubature.hessian(q, WEIGHTS) @ d

    def value_left(h: float) -> float:
        return cubature.value_and_gradient(q + h * d, WEIGHTS)[0] - value - h * (gradient @ d)

    def gradient_left(h: float) -> FloatArray:
        return cubature.value_and_gradient(q + h * d, WEIGHTS)[1] - gradient - h * product

    assert observed_order(value_left) == pytest.approx(2, abs=0.1)
    assert observed_order(gradient_left) == pytest.approx(2, abs=0.15)


def test_live_blends_are_near_full_solutions(model: InterpolationModel) -> None:
    one = model.problem
    weights = sample(one.domain, 8, seed=7)
    full = solve_snapshots(one, weights, threads=1)
    session = model.session()
    errors = []
    for k, w in enumerate(weights):
        session.blend(w)
        shape = one.base + full.displacements[k]
        same = one.aligned(session.vertices.reshape(-1), shape)
        errors.append(mass_norm(one.mass(), same - shape) / mass_norm(one.mass(), shape - one.tau))
    assert np.median(errors) < 0.02


def test_models_are_saved_and_loaded(model: InterpolationModel, tmp_path: Path) -> None:
    again = load(model.save(tmp_path / "sheet.snapspace"))
    assert isinstance(again, InterpolationModel)
    assert isinstance(again.problem.poses, ShellPoses)
    session, other = model.session(), again.session()
    session.blend(WEIGHTS)
    other.blend(WEIGHTS)
    size = model.problem.mesh.diagonal
    np.testing.assert_allclose(other.vertices, session.vertices, atol=1e-5 * size)


def test_problems_are_pickled() -> None:
    one = problem(StableNeoHookean())
    again = pickle.loads(pickle.dumps(one))
    assert again.fingerprint == one.fingerprint
    assert isinstance(again.poses, ShellPoses)


def test_poses_that_are_none_are_refused() -> None:
    first, second, _ = poses()
    thick = ShellMesh(second.vertices, second.triangles, thickness=0.1)
    with pytest.raises(ValueError, match="pose 1 has another thickness than pose 0"):
        ShellPoses.of([first, thick])
    with pytest.raises(ValueError, match="pose 1: face 0 has vertices"):
        ShellPoses.of([first, ShellMesh(first.vertices, first.triangles[::-1], thickness=0.04)])
    with pytest.raises(ValueError, match="got 1 pose, but at least two"):
        ShellPoses.of([first])
    flat = second.vertices.copy()
    a, b, c = second.triangles[3]
    flat[c] = (flat[a] + flat[b]) / 2
    with pytest.raises(ValueError, match=r"ShellPoses: pose 1: triangle 3 .* has no area"):
        ShellPoses([first.vertices, flat], first.triangles, thickness=0.1)
    apart = np.concatenate([first.vertices, first.vertices + 5.0])
    faces = np.concatenate([first.triangles, first.triangles + len(first.vertices)])
    with pytest.raises(ValueError, match="the surface has 2 components"):
        ShellPoses([apart, 2 * apart], faces, thickness=0.1)
