"""The scalar factor of an interpolation problem, adapted to shapes near given ones."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, InterpolationProblem, Poses, StVK, TetMesh
from snapspace import _core as core

from ..shapes import deformed, interpolation_problem, irregular_bar

FloatArray = NDArray[np.float64]
PROBLEM = interpolation_problem()


def rest_system(problem: InterpolationProblem = PROBLEM) -> core.InterpolationSystem:
    """The system with the factor for pose 0."""
    shapes = problem._near_poses.reshape(problem.poses.shapes.shape)
    material = problem.material
    return core.InterpolationSystem(shapes, problem.poses.tets, material.core)


def solve(
    system: core.InterpolationSystem, problem: InterpolationProblem, weights: FloatArray
) -> core.Batch:
    """Solves from the mean shape."""
    starts = np.repeat((problem.tau - problem.base)[None], len(weights), axis=0)
    return system.solve_fast(
        weights,
        starts,
        tolerance=1e-9,
        max_iterations=5000,
        threads=1,
        control=core.SolveControl(),
        lanes=2,
    )


def scalar_hessian(x: FloatArray, problem: InterpolationProblem = PROBLEM) -> FloatArray:
    """A third of the traces of the 3 x 3 blocks of the mean of all poses' Hessians, (n, n)."""
    n = len(problem.mesh.vertices)
    total = np.zeros((n, n))
    for pose in problem.poses.shapes:
        energy = ElasticEnergy(TetMesh(pose, problem.poses.tets), problem.material)
        blocks = energy.hessian(x).toarray().reshape(n, 3, n, 3)
        total += np.trace(blocks, axis1=1, axis2=3) / (3 * len(problem.poses))
    return total


def smallest_stretch(x: FloatArray) -> float:
    """The smallest singular value of any tet, relative to any pose."""
    tets, shape = PROBLEM.poses.tets, x.reshape(-1, 3)
    edges = shape[tets[:, 1:]] - shape[tets[:, :1]]
    least = np.inf
    for pose in PROBLEM.poses.shapes:
        rest = pose[tets[:, 1:]] - pose[tets[:, :1]]
        values = np.linalg.svd(np.linalg.solve(rest, edges), compute_uv=False)
        least = min(least, float(values.min()))
    return least


def adapted(
    system: core.InterpolationSystem, displacements: FloatArray
) -> core.InterpolationSystem:
    """The system adapted to displacements at equal weights."""
    weights = np.tile(PROBLEM.domain.center, (len(displacements), 1))
    other: core.InterpolationSystem = system.adapted(displacements, weights)
    return other


def stretched(size: float, seed: int) -> FloatArray:
    """A shape in which every tet is longer in all directions than in every pose."""
    x = size * deformed(PROBLEM.mesh, 0.05, seed=seed)
    assert smallest_stretch(x) > 1
    return x


def forces(seed: int) -> FloatArray:
    """A vector that sums to zero per coordinate, as gradients do."""
    f = np.random.default_rng(seed).normal(size=(len(PROBLEM.mesh.vertices), 3))
    return (f - f.mean(axis=0)).reshape(-1)


@pytest.mark.parametrize("sizes", [(2.5,), (4.0,), (2.5, 4.0)])
def test_the_matrix_is_the_mean_of_the_scalar_hessians(sizes: tuple[float, ...]) -> None:
    """Where all tets are stretched, nothing is clamped. The regular vertex changes translations."""
    shapes = np.stack([stretched(size, k) for k, size in enumerate(sizes)])
    system = adapted(rest_system(), shapes - PROBLEM.base)
    A = np.mean([scalar_hessian(x) for x in shapes], axis=0)
    f = forces(1)
    solution = system.precondition(f)
    back = (A @ solution.reshape(-1, 3)).reshape(-1)
    np.testing.assert_allclose(back, f, rtol=0, atol=1e-9 * np.abs(f).max())


@pytest.mark.parametrize("size", [0.0, 0.3, 2.0])
def test_the_preconditioner_is_symmetric_and_positive(size: float) -> None:
    """It is so even far from all poses, with compressed and inverted tets."""
    x = deformed(PROBLEM.mesh, size)
    system = adapted(rest_system(), (x - PROBLEM.base)[None])
    f = np.stack([forces(seed) for seed in range(12)])
    gram = f @ np.stack([system.precondition(one) for one in f]).T
    np.testing.assert_allclose(gram, gram.T, rtol=0, atol=1e-10 * np.abs(gram).max())
    assert np.linalg.eigvalsh(gram).min() > 0


def test_coordinates_are_preconditioned_alike() -> None:
    one = forces(3).reshape(-1, 3)
    solution = PROBLEM.system.precondition(one.reshape(-1)).reshape(-1, 3)
    turned = PROBLEM.system.precondition(one[:, [1, 2, 0]].reshape(-1)).reshape(-1, 3)
    np.testing.assert_array_equal(turned, solution[:, [1, 2, 0]])


def test_adapting_leaves_the_system_as_it_was() -> None:
    weights = np.array([[0.5, 0.2, 0.3], [0.1, 0.1, 0.8]])
    system = rest_system()
    before, f = solve(system, PROBLEM, weights), forces(4)
    preconditioned = system.precondition(f)
    other = adapted(system, (stretched(4.0, 0) - PROBLEM.base)[None])
    assert not np.allclose(other.precondition(f), preconditioned, rtol=0.1)
    np.testing.assert_array_equal(system.precondition(f), preconditioned)
    np.testing.assert_array_equal(solve(system, PROBLEM, weights).shapes, before.shapes)
    del system  # the adapted system does not need it
    assert all(r.status.name == "converged" for r in solve(other, PROBLEM, weights).reports)


def test_adapting_does_not_change_the_objective() -> None:
    system, u = rest_system(), deformed(PROBLEM.mesh, 0.2) - PROBLEM.base
    other = adapted(system, u[None])
    for w in ([0.5, 0.2, 0.3], [1.3, -0.2, -0.1]):
        value, gradient = system.value_and_gradient(u, np.array(w))
        again, gradient_again = other.value_and_gradient(u, np.array(w))
        assert again == value
        np.testing.assert_array_equal(gradient_again, gradient)


def test_adapting_starts_anew() -> None:
    """An earlier adaptation does not count."""
    u, v = (stretched(size, 0) - PROBLEM.base for size in (2.5, 4.0))
    f = forces(5)
    direct = adapted(rest_system(), v[None])
    detour = adapted(adapted(rest_system(), u[None]), v[None])
    np.testing.assert_array_equal(detour.precondition(f), direct.precondition(f))


def pressed_bar() -> InterpolationProblem:
    """A bar, and one with a middle a fifth as thick: the mean shape stretches those tets much."""
    mesh = irregular_bar(8, 2, 2)
    pose = mesh.vertices.copy()
    x, z = pose[:, 0], pose[:, 2]
    middle = (x > 0.3 * x.max()) & (x < 0.7 * x.max())
    pose[middle, 2] = z.mean() + 0.2 * (z[middle] - z.mean())
    return InterpolationProblem(Poses(np.stack([mesh.vertices, pose]), mesh.tets), material=StVK())


def test_a_factor_for_the_mean_shape_needs_far_fewer_iterations() -> None:
    problem = pressed_bar()
    weights = np.array([[0.4, 0.6], [0.6, 0.4], [0.2, 0.8]])
    counts = []
    for system in (rest_system(problem), problem.system):
        reports = solve(system, problem, weights).reports
        assert all(report.status.name == "converged" for report in reports)
        counts.append(sum(report.iterations for report in reports))
    assert counts[1] < 0.4 * counts[0], counts
