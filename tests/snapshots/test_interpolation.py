"""Full solves between poses, compared with properties known without solving."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationProblem, Poses, SolverOptions, sample, solve_snapshots
from snapspace.generators import cylinder, helix
from snapspace.mesh import tet_volumes
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from ..shapes import (
    bent,
    interpolation_problem,
    irregular_bar,
    mirror_image,
    moved,
    random_rotation,
    symmetric_bar,
)
from .bars import core_solve

FloatArray = NDArray[np.float64]
PROBLEM = interpolation_problem()


def tight(solver: Solver = "newton") -> SolverOptions:
    return SolverOptions(solver=solver, tolerance=1e-13, max_iterations=5000)


def solve(
    problem: InterpolationProblem, weights: FloatArray, solver: Solver = "newton"
) -> FloatArray:
    """Shapes (k, 3n) of converged solves."""
    solved = solve_snapshots(problem, weights, options=tight(solver), threads=1)
    assert solved.converged.all()
    return solved.shapes


@pytest.mark.parametrize("solver", SOLVERS)
def test_equal_poses_give_that_pose_for_any_weights(solver: Solver) -> None:
    mesh = irregular_bar(6, 2, 2)
    pose = bent(mesh, 0.8)
    problem = InterpolationProblem(Poses(np.stack([pose] * 3), mesh.tets), extrapolation=0.5)
    weights = sample(problem.domain, 10, seed=4)
    assert weights.min() < -0.05
    for shape in solve(problem, weights, solver):
        assert shape == pytest.approx(pose.reshape(-1), abs=1e-8)


@pytest.mark.parametrize("solver", SOLVERS)
def test_rigidly_moved_copies_give_a_rigid_copy(solver: Solver) -> None:
    """The shape is in the frame of the first pose; blends with rotated copies do not shrink."""
    mesh = irregular_bar(6, 2, 2)
    pose = bent(mesh, 0.8)
    copies = [pose]
    for seed in range(2):
        turned = moved(pose.reshape(-1), random_rotation(seed), 5.0 * seed)
        copies.append(turned.reshape(-1, 3))
    problem = InterpolationProblem(Poses(np.stack(copies), mesh.tets))
    assert problem.tau == pytest.approx(pose.reshape(-1), abs=1e-8)
    for shape in solve(problem, sample(problem.domain, 10, seed=4), solver):
        assert shape == pytest.approx(pose.reshape(-1), abs=1e-8)


@pytest.mark.parametrize("solver", SOLVERS)
def test_one_hot_weights_give_back_the_pose(solver: Solver) -> None:
    solved = solve_snapshots(PROBLEM, np.eye(3), options=SolverOptions(solver=solver), threads=1)
    assert solved.converged.all()
    assert solved.shapes == pytest.approx(PROBLEM.pose_shapes, abs=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_one_hot_weights_lead_to_the_pose_from_the_mean_shape(solver: Solver) -> None:
    """The compiled solvers have no poses to start from."""
    starts = np.tile(PROBLEM.tau - PROBLEM.base, (3, 1))
    batch = core_solve(PROBLEM, solver, np.eye(3), starts, tolerance=1e-13, max_iterations=2000)
    assert [report.status.name for report in batch.reports] == ["converged"] * 3
    shapes = PROBLEM.registered(batch.shapes) + PROBLEM.base
    assert shapes == pytest.approx(PROBLEM.pose_shapes, abs=1e-7)


@pytest.mark.parametrize("solver", SOLVERS)
def test_mirrored_weights_on_mirrored_poses_give_mirrored_shapes(solver: Solver) -> None:
    """A bar bends left and right; equal weights give a shape that is its own mirror image."""
    mesh = symmetric_bar()
    image = mirror_image(mesh)
    left, right = bent(mesh, 1.0), bent(mesh, -1.0)
    mirror = np.array([1.0, -1.0, 1.0])
    assert left[image] * mirror == pytest.approx(right, abs=1e-14)
    problem = InterpolationProblem(Poses(np.stack([left, right]), mesh.tets))

    weights = np.array([[0.5, 0.5], [0.3, 0.7], [0.7, 0.3], [0.1, 0.9], [0.9, 0.1]])
    shapes = solve(problem, weights, solver).reshape(5, -1, 3)
    for a, b in ((0, 0), (1, 2), (3, 4)):
        mirrored = (shapes[a][image] * mirror).reshape(-1)
        other = shapes[b].reshape(-1)
        assert problem.aligned(mirrored, other) == pytest.approx(other, abs=1e-6)
    assert np.abs(shapes[1] - shapes[2]).max() > 0.1


def test_fast_and_newton_agree_on_the_minimum() -> None:
    weights = sample(PROBLEM.domain, 8, seed=3)
    fast, newton = (
        solve_snapshots(PROBLEM, weights, options=tight(solver), threads=1) for solver in SOLVERS
    )
    assert fast.converged.all() and newton.converged.all()
    values = [report.value for report in newton.reports]
    assert [report.value for report in fast.reports] == pytest.approx(values, rel=1e-6)
    assert fast.shapes == pytest.approx(newton.shapes, abs=1e-5)
    for w, x, report in zip(weights, newton.shapes, newton.reports, strict=True):
        value, gradient = PROBLEM.value_and_gradient(x, w)
        tension = max(np.linalg.norm(PROBLEM.value_and_gradient(x, e)[1]) for e in np.eye(3))
        assert report.value == pytest.approx(value, rel=1e-9)
        assert np.linalg.norm(gradient) < 1e-5 * tension


def test_shapes_are_registered_to_the_mean_shape() -> None:
    for shape in solve(PROBLEM, sample(PROBLEM.domain, 5, seed=3)):
        assert PROBLEM.aligned(shape, PROBLEM.tau) == pytest.approx(shape, abs=1e-12)


def test_weights_beyond_the_simplex_are_solved_in_a_larger_domain() -> None:
    """Beyond the bent pose the bar bends further; beyond the straight one, the other way."""
    mesh = irregular_bar(8, 2, 2)
    poses = Poses(np.stack([mesh.vertices, bent(mesh, 0.8)]), mesh.tets)
    problem = InterpolationProblem(poses, extrapolation=0.4)
    start, middle, end = (np.abs(mesh.vertices[:, 0] - x) < 0.2 for x in (0.0, 2.0, 4.0))

    def bend(shape: FloatArray) -> float:
        """Angle from the first half of the bar to the second, positive in the sense of bent()."""
        a, b, c = (shape.reshape(-1, 3)[part].mean(axis=0) for part in (start, middle, end))
        turn = np.cross(b - a, c - b)[2] / np.linalg.norm(b - a) / np.linalg.norm(c - b)
        return float(np.arcsin(turn))

    inside = bend(problem.pose_shapes[1])
    beyond, other = solve(problem, np.array([[-0.2, 1.2], [1.2, -0.2]]))
    assert bend(beyond) == pytest.approx(1.2 * inside, rel=0.1)
    assert bend(other) == pytest.approx(-0.2 * inside, rel=0.25)


def test_samples_outside_of_the_simplex_are_refused() -> None:
    for weights, message in (
        ([[0.5, 0.5, 0.0], [1.2, -0.2, 0.0]], r"weight 1 is -0\.2, but none may be below 0"),
        ([[0.5, 0.5, 0.1]], r"the weights sum to 1\.1, but they must sum to 1"),
        ([[0.5, 0.5]], r"parameters have shape \(1, 2\), but the problem needs \(samples, 3\)"),
    ):
        with pytest.raises(ValueError, match=message):
            solve_snapshots(PROBLEM, weights, threads=1)


@pytest.fixture(scope="module")
def coil() -> InterpolationProblem:
    return InterpolationProblem([cylinder(2, 26), helix(2, 26)])


def test_the_volume_stays_from_cylinder_to_helix(coil: InterpolationProblem) -> None:
    """It stays within 5 % of the volumes between those of the ends. The straight path of the
    vertices loses up to 60 %. (Measured: 4.1 %; 3.2 % with twice the layers of tets.)
    """
    share = np.linspace(0, 1, 9)
    weights = np.column_stack([1 - share, share])
    solved = solve_snapshots(coil, weights, threads=1)
    assert solved.converged.all()
    assert max(report.inverted_tets for report in solved.reports) == 0
    ends = weights @ coil.poses.volumes.sum(axis=1)

    def volumes(shapes: list[FloatArray]) -> FloatArray:
        return np.array([tet_volumes(x.reshape(-1, 3), coil.poses.tets).sum() for x in shapes])

    assert np.abs(volumes(list(solved.shapes)) / ends - 1).max() < 0.05
    linear = volumes([coil.linear_blend(w) for w in weights]) / ends
    assert linear[4] < 0.7
    assert linear.min() == pytest.approx(0.38, abs=0.02)


def test_the_path_from_cylinder_to_helix_has_no_jumps(coil: InterpolationProblem) -> None:
    """All samples end in one family of minima, so consecutive steps are alike."""
    share = np.linspace(0, 1, 41)
    solved = solve_snapshots(coil, np.column_stack([1 - share, share]), threads=1)
    steps = np.linalg.norm(np.diff(solved.shapes, axis=0), axis=1)
    assert np.abs(np.diff(np.log(steps))).max() < 0.2
