"""Solutions known without solving: rest, rigid motions, mirror images."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import PosingProblem, SolverOptions, TetMesh, solve_snapshots
from snapspace.problem import rotation_matrix
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from .bars import core_solve, parameters, posing_bar, tight

FloatArray = NDArray[np.float64]


def solve_targets(
    problem: PosingProblem, positions: FloatArray, *, solver: Solver, tolerance: float = 1e-14
) -> tuple[FloatArray, Any]:
    """Vertices (n, 3) that minimise F with the targets `positions` (p, 3) of pinned vertices."""
    targets = (positions - problem.mesh.vertices[problem.pinned])[None]
    starts = np.zeros((1, problem.mesh.vertices.size))
    batch = core_solve(problem, solver, targets, starts, tolerance=tolerance, max_iterations=300)
    return problem.mesh.vertices + batch.shapes[0].reshape(-1, 3), batch.reports[0]


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_motion_is_the_rest_shape(solver: Solver) -> None:
    problem = posing_bar()
    solved = solve_snapshots(
        problem, np.zeros((1, 6)), options=SolverOptions(solver=solver), threads=1
    )
    report = solved.reports[0]
    assert report.converged and report.iterations <= 1
    assert report.value == 0.0
    np.testing.assert_array_equal(solved.shapes[0], problem.mesh.vertices.reshape(-1))


@pytest.mark.parametrize("solver", SOLVERS)
def test_handles_that_move_as_one_body_carry_the_shape_along(solver: Solver) -> None:
    """The rigidly moved rest shape has no energy, so it is exactly the minimiser."""
    problem = posing_bar()
    rotation, shift = rotation_matrix([0.4, -0.3, 0.9]), np.array([0.3, 0.2, -0.5])
    moved = problem.mesh.vertices @ rotation.T + shift
    found, report = solve_targets(problem, moved[problem.pinned], solver=solver)
    np.testing.assert_allclose(found, moved, atol=1e-12)
    assert report.value < 1e-20
    assert report.status.name == "converged"


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_common_rigid_motion_moves_the_minimiser(solver: Solver) -> None:
    problem = posing_bar()
    offsets = problem.offsets(parameters(problem, 1)[0])
    targets = problem.mesh.vertices[problem.pinned] + problem.target_displacements(offsets)
    here, report = solve_targets(problem, targets, solver=solver)
    assert report.value > 0.0
    rotation, shift = rotation_matrix([0.2, 0.5, -0.3]), np.array([-0.2, 0.4, 0.1])
    there, moved_report = solve_targets(problem, targets @ rotation.T + shift, solver=solver)
    assert moved_report.value == pytest.approx(report.value, rel=1e-12)
    np.testing.assert_allclose(there, here @ rotation.T + shift, atol=1e-6)


def mirrored(problem: PosingProblem) -> NDArray[np.intp]:
    """The mirror image of each vertex when y and z are exchanged.

    A bar of square cross-section is divided alike along y and z, so the mesh is its own image.
    """
    order = {tuple(vertex): i for i, vertex in enumerate(problem.mesh.vertices.round(9).tolist())}
    image = [order[x, z, y] for x, y, z in problem.mesh.vertices.round(9).tolist()]
    tets = {frozenset(tet) for tet in problem.mesh.tets.tolist()}
    assert tets == {frozenset(image[i] for i in tet) for tet in problem.mesh.tets.tolist()}
    return np.array(image)


@pytest.mark.parametrize("solver", SOLVERS)
def test_symmetric_motions_give_symmetric_shapes(solver: Solver) -> None:
    problem = posing_bar()
    image = mirrored(problem)
    motions = np.array([[0.2, 0.0, 0.0, 0, 0, 0], [-0.1, 0.15, 0.15, 0, 0, 0]])
    solved = solve_snapshots(problem, motions, options=tight(solver), threads=1)
    assert solved.converged.all()
    for shape in solved.shapes.reshape(2, -1, 3):
        np.testing.assert_allclose(shape[image][:, [0, 2, 1]], shape, atol=1e-7)


@pytest.mark.parametrize("solver", SOLVERS)
def test_mirrored_motions_give_mirrored_shapes(solver: Solver) -> None:
    """The mirror y <-> z swaps translations and turns a rotation by (a, 0, 0) into (-a, 0, 0)."""
    problem = posing_bar()
    motions = np.array([[0.1, 0.2, -0.05, 0.2, 0, 0], [0.1, -0.05, 0.2, -0.2, 0, 0]])
    solved = solve_snapshots(problem, motions, options=tight(solver), threads=1)
    one, other = solved.shapes.reshape(2, -1, 3)
    np.testing.assert_allclose(other, one[mirrored(problem)][:, [0, 2, 1]], atol=1e-7)
    assert np.abs(other - one).max() > 0.1


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_larger_copy_is_solved_by_the_larger_shape(solver: Solver) -> None:
    """With stiffness times squared length constant, F grows with the volume, x with the size."""
    small = posing_bar(stiffness=500.0)
    large = PosingProblem(
        TetMesh(3.0 * small.mesh.vertices, small.mesh.tets),
        small.handles,
        domain=small.domain,
        material=small.material,
        stiffness=500.0 / 9.0,
    )
    w = parameters(small, 1)
    factors = np.array([3.0, 3.0, 3.0, 1.0, 1.0, 1.0])
    one = solve_snapshots(small, w, options=tight(solver), threads=1)
    other = solve_snapshots(large, w * factors, options=tight(solver), threads=1)
    assert other.reports[0].value == pytest.approx(27.0 * one.reports[0].value, rel=1e-12)
    np.testing.assert_allclose(other.shapes, 3.0 * one.shapes, atol=1e-6)
