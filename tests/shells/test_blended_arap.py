"""Blends of as-rigid-as-possible surfaces: energies, their few stars, models."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import (
    ARAP,
    InterpolationModel,
    InterpolationProblem,
    ShellMesh,
    SolverOptions,
    calibrate,
    load,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.cubature import BlendedStars
from snapspace.mesh import mass_norm

from ..taylor import observed_order
from .sheets import irregular, rolled, sheet

FloatArray = NDArray[np.float64]

SQUARE = irregular(25, thickness=0.04)
WEIGHTS = np.array([0.2, 0.5, 0.3])


def blended(flat: ShellMesh, radius: float) -> InterpolationProblem:
    """A sheet: flat, rolled up and turned, and stretched and bent the other way."""
    turn = Rotation.from_rotvec([0.3, 1.0, -0.5]).as_matrix()
    shapes = [
        flat.vertices,
        rolled(flat.vertices, 2.0, 0.4).reshape(-1, 3) @ turn.T,
        rolled(flat.vertices * [1.2, 0.9, 1.0], -1.0, 1.3).reshape(-1, 3),
    ]
    mu = np.linspace(0.5, 2.0, len(flat.triangles))
    meshes = [ShellMesh(x, flat.triangles, thickness=flat.thickness) for x in shapes]
    return InterpolationProblem(meshes, material=ARAP(mu=mu, radius=radius))


@pytest.fixture(params=[0.0, 0.15], ids=["rings", "radius"], scope="module")
def problem(request: pytest.FixtureRequest) -> InterpolationProblem:
    return blended(SQUARE, request.param)


@pytest.mark.parametrize("weights", [*np.eye(3), WEIGHTS, np.array([1.3, -0.1, -0.2])])
def test_the_blend_is_the_weighted_sum_of_the_poses_energies(
    problem: InterpolationProblem, weights: FloatArray
) -> None:
    """The full blend comes from another form than the energies of the poses."""
    assert_weighted_sum(problem, weights)


def test_stars_of_several_tiles_are_summed_as_others() -> None:
    """The core visits the corners of a star in tiles of 128."""
    problem = blended(irregular(600, thickness=0.04), radius=0.4)
    assert np.diff(problem.pose_energy(0).stars().corners()[0]).max() > 2 * 128
    assert_weighted_sum(problem, WEIGHTS)


def assert_weighted_sum(problem: InterpolationProblem, weights: FloatArray) -> None:
    rng = np.random.default_rng(0)
    x = problem.tau + 0.03 * rng.normal(size=problem.tau.size)
    value, gradient = problem.value_and_gradient(x, weights)
    parts = [
        problem.pose_energy(k).value_and_gradient(x - problem.pose_shapes[k]) for k in range(3)
    ]
    expected = sum(w * part[0] for w, part in zip(weights, parts, strict=True))
    slope = sum(w * part[1] for w, part in zip(weights, parts, strict=True))
    assert value == pytest.approx(expected, rel=1e-11)
    np.testing.assert_allclose(gradient, slope, atol=1e-11 * np.abs(slope).max())


def test_the_gradient_is_that_of_the_energy(problem: InterpolationProblem) -> None:
    rng = np.random.default_rng(1)
    x, d = problem.tau, 1e-2 * rng.normal(size=problem.tau.size)
    x = x + rng.normal(size=len(x)) * 0.03
    value, gradient = problem.value_and_gradient(x, WEIGHTS)

    def left(h: float) -> float:
        return problem.value_and_gradient(x + h * d, WEIGHTS)[0] - value - h * (gradient @ d)

    assert observed_order(left) == pytest.approx(2, abs=0.1)


def test_one_hot_weights_have_the_pose_as_minimum(problem: InterpolationProblem) -> None:
    for pose, weights in zip(problem.pose_shapes, np.eye(3), strict=True):
        value, gradient = problem.value_and_gradient(pose, weights)
        assert abs(value) < 1e-15 and np.abs(gradient).max() < 1e-12


def test_all_starts_lead_to_one_minimum(problem: InterpolationProblem) -> None:
    """Shells with hinges have many minima between such poses."""
    system = problem.system
    starts = np.stack([*problem.pose_shapes, problem.tau]) - problem.base
    weights = np.repeat(WEIGHTS[None], len(starts), axis=0)
    batch = system.solve_fast(
        weights,
        starts,
        tolerance=1e-13,
        max_iterations=2000,
        threads=1,
        control=core.SolveControl(),
    )
    shapes = problem.registered(batch.shapes) + problem.base
    size = mass_norm(problem.mass(), problem.pose_shapes[1] - problem.pose_shapes[0])
    for shape in shapes[1:]:
        assert mass_norm(problem.mass(), shape - shapes[0]) < 1e-4 * size


@pytest.fixture(params=[None, 0.2], ids=["default", "radius"], scope="module")
def model(request: pytest.FixtureRequest) -> InterpolationModel:
    flat = sheet(10, 6, thickness=0.1)
    shapes = [flat.vertices, rolled(flat.vertices, 1.0, 0.2), rolled(flat.vertices, -1.2, 1.2)]
    one = InterpolationProblem(
        [ShellMesh(shape, flat.triangles, thickness=0.1) for shape in shapes],
        material=None if request.param is None else ARAP(radius=request.param),
    )
    if request.param is None:
        assert one.material == ARAP(radius=0.05), "surfaces are as rigid as possible by default"
    snapshots = solve_snapshots(one, sample(one.domain, 24, seed=1), threads=1)
    assert snapshots.converged.all()
    subspace = snapshot_pca(snapshots, dimension=12)
    return reduce(one, subspace, snapshots=snapshots, threads=1)


@pytest.mark.parametrize("weights", [WEIGHTS, np.array([0.0, 1.0, 0.0])])
def test_all_stars_are_the_energy(model: InterpolationModel, weights: FloatArray) -> None:
    one, subspace = model.problem, model.subspace
    areas = one.pose_energies.stars[0].measures
    every = np.arange(len(areas), dtype=np.int32)
    whole = BlendedStars.of_tets(one, subspace, every, areas)
    rng = np.random.default_rng(0)
    q = 0.1 * model.coordinate_scale * rng.normal(size=model.dimension)
    value, gradient = one.value_and_gradient(subspace.shape(q), weights)
    reduced, slope = whole.value_and_gradient(q, weights)
    assert reduced == pytest.approx(value, rel=1e-4)
    exact = subspace.basis.T @ gradient
    np.testing.assert_allclose(slope, exact, atol=1e-4 * np.abs(exact).max())
    hessian = whole.hessian(q, weights)
    np.testing.assert_allclose(
        whole.rough_hessian(q, weights), hessian, atol=1e-5 * np.abs(hessian).max()
    )
    kept = q * (np.arange(len(q)) < 5)
    assert whole.leading(5).value_and_gradient(q[:5], weights)[0] == pytest.approx(
        whole.value_and_gradient(kept, weights)[0], rel=1e-5
    )


def test_few_stars_are_consistent(model: InterpolationModel) -> None:
    stars = model.cubature
    assert isinstance(stars, BlendedStars)
    rng = np.random.default_rng(2)
    q, d = 0.02 * rng.normal(size=12), 0.004 * rng.normal(size=12)
    value, gradient = stars.value_and_gradient(q, WEIGHTS)
    product = stars.hessian(q, WEIGHTS) @ d

    def value_left(h: float) -> float:
        return stars.value_and_gradient(q + h * d, WEIGHTS)[0] - value - h * (gradient @ d)

    def gradient_left(h: float) -> FloatArray:
        return stars.value_and_gradient(q + h * d, WEIGHTS)[1] - gradient - h * product

    assert observed_order(value_left) == pytest.approx(2, abs=0.1)
    assert observed_order(gradient_left) == pytest.approx(2, abs=0.15)


def test_live_blends_are_near_full_solutions(model: InterpolationModel) -> None:
    one, session = model.problem, model.session()
    weights = sample(one.domain, 8, seed=7)
    full = solve_snapshots(one, weights, threads=1)
    for w, shape in zip(weights, full.shapes, strict=True):
        session.blend(w)
        same = one.aligned(session.vertices.reshape(-1), shape)
        size = mass_norm(one.mass(), shape - one.tau)
        assert mass_norm(one.mass(), same - shape) < 0.01 * size


def test_paths_are_continuous_and_the_same_both_ways(model: InterpolationModel) -> None:
    session = model.session()
    ways = np.linspace([1.0, 0.0, 0.0], [0.0, 0.2, 0.8], 41)

    def walk(path: FloatArray) -> FloatArray:
        return np.array([session.blend(w) and session.vertices for w in path])

    forth, back = walk(ways), walk(ways[::-1])[::-1]
    diagonal = model.problem.mesh.diagonal
    assert np.abs(forth - back).max() < 1e-3 * diagonal
    steps = np.linalg.norm(np.diff(forth, axis=0), axis=2).max(axis=1)
    assert steps.max() < 4 * np.median(steps)


def test_newton_finds_the_same_solutions(model: InterpolationModel) -> None:
    """It takes a few iterations: its Hessians have all pairs of vertices in a star."""
    one, weights = model.problem, sample(model.problem.domain, 3, seed=3)
    fast, newton = (
        solve_snapshots(
            one, weights, options=SolverOptions(solver=solver, tolerance=1e-12), threads=1
        )
        for solver in ("fast", "newton")
    )
    assert newton.converged.all() and max(r.iterations for r in newton.reports) < 30
    for first, second in zip(fast.reports, newton.reports, strict=True):
        assert second.value == pytest.approx(first.value, rel=1e-9)


@pytest.mark.parametrize("pose", [0, 1, 2])
def test_the_certain_range_ends_where_the_energy_falls_forever(
    model: InterpolationModel, pose: int
) -> None:
    stars, certain = model.cubature, model.certain_range
    assert isinstance(stars, BlendedStars) and certain is not None
    lower, upper = certain.limits()[pose]
    for end in (lower, upper):
        for inside in (0.99, 1.01):
            weights = np.full(3, (1.0 - inside * end) / 2.0)
            weights[pose] = inside * end
            form = np.einsum("k,kij->ij", weights, stars.dirichlet_forms)
            softest = np.linalg.eigh(form)[1][:, 0]
            far = min(
                stars.value_and_gradient(sign * 1e9 * softest, weights)[0] for sign in (1, -1)
            )
            assert certain.holds(weights) == (inside < 1.0) == (far > 0.0)
    whole = model.problem.certain_range
    assert whole is not None
    assert whole.limits()[pose, 0] >= lower and whole.limits()[pose, 1] <= upper


def test_models_are_saved_and_loaded(model: InterpolationModel, tmp_path: Path) -> None:
    calibrated = calibrate(model, samples=12, threads=1)
    again = load(calibrated.save(tmp_path / "sheet.snapspace"))
    assert isinstance(again, InterpolationModel) and isinstance(again.blends, BlendedStars)
    session, other = calibrated.session(), again.session()
    session.blend(WEIGHTS)
    other.blend(WEIGHTS)
    size = model.problem.mesh.diagonal
    np.testing.assert_allclose(other.vertices, session.vertices, atol=1e-5 * size)
    found, loaded = session.certificate(), other.certificate()
    assert loaded.relative == pytest.approx(found.relative, rel=0.05)
    assert 0.0 < found.relative < found.upper_relative < 0.2


def test_frames_sum_over_no_triangles_of_the_surface(
    model: InterpolationModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The unit of energy of the termination tests does: the first frame keeps it."""
    session = model.session()
    session.blend(WEIGHTS)
    monkeypatch.delattr("snapspace.reduction.reduced_model.rigidities")
    assert session.blend(WEIGHTS[::-1]).converged


def test_polish_ends_at_the_full_solution(model: InterpolationModel) -> None:
    one, session = model.problem, model.session()
    session.blend(WEIGHTS)
    polished = session.polish(iterations=300, tolerance=1e-12)
    full = solve_snapshots(
        one, WEIGHTS[None], options=SolverOptions(tolerance=1e-12), threads=1
    ).shapes[0]
    same = one.aligned(polished.vertices.reshape(-1), full)
    assert mass_norm(one.mass(), same - full) < 1e-3 * mass_norm(one.mass(), full - one.tau)


def test_stars_are_pickled_and_checked(model: InterpolationModel) -> None:
    stars = model.blends
    assert isinstance(stars, BlendedStars)
    again = pickle.loads(pickle.dumps(stars))
    q = np.full(model.dimension, 0.01)
    assert again.value_and_gradient(q, WEIGHTS)[0] == stars.value_and_gradient(q, WEIGHTS)[0]
    parts = stars.tets, stars.weights, stars.rows, stars.material, stars.origins, stars.forms
    for place, wrong, message in (
        (1, -stars.weights, "weights must be positive"),
        (2, stars.rows[0], r"rows must be \(poses, r, 9, d\)"),
        (3, stars.material.of_tets(stars.tets[:1]), "the material has 1 elements"),
        (4, stars.origins[:1], "origins must be"),
        (5, stars.forms[:, 1:], "forms must be"),
    ):
        with pytest.raises(ValueError, match=message):
            BlendedStars(*parts[:place], wrong, *parts[place + 1 :])
    with pytest.raises(ValueError, match="BlendedStars: tets must be between 0 and"):
        BlendedStars.of_tets(model.problem, model.subspace, np.array([10**6], np.int32), np.ones(1))
