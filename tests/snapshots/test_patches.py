"""Rigid motions of patches in the seed of blends of as-rigid-as-possible surfaces."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    InterpolationProblem,
    Predictions,
    ShellMesh,
    Snapshots,
    SolverOptions,
    StableNeoHookean,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.mesh import mass_norm

from ..shells.sheets import rolled, sheet
from ..shells.strips import rolled_strips
from .bars import assert_same_bits

FloatArray = NDArray[np.float64]
TIGHT = SolverOptions(tolerance=1e-12, max_iterations=5000)
EIGHT: dict[str, Any] = {"tolerance": 1e-300, "max_iterations": 8, "threads": 1}


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return rolled_strips()


@pytest.fixture(scope="module")
def wanted(problem: InterpolationProblem) -> FloatArray:
    return sample(problem.domain, 9, seed=5)


@pytest.fixture(scope="module")
def solved(problem: InterpolationProblem, wanted: FloatArray) -> Snapshots:
    return solve_snapshots(problem, wanted, options=TIGHT)


def without_patches(problem: InterpolationProblem, count: int) -> tuple[FloatArray, FloatArray]:
    """A basis and inverses so small that the seed is the scalar inverse alone."""
    basis = np.ones((problem.base.size, 1))
    return basis, np.full((count, 1, 1), 1e-30)


def correction(problem: InterpolationProblem, shape: FloatArray, w: FloatArray) -> FloatArray:
    """What the patches add to the seed, times the gradient at a displacement."""
    _, gradients, _, images = problem.system.evaluate_in_pack(
        shape[None], w[None], width=2, single=False
    )
    result: FloatArray = images[0] - problem.system.precondition(gradients[0])
    return result


def left_by_correction(problem: InterpolationProblem, minimum: FloatArray, w: FloatArray) -> float:
    """The share of a step in the patches' space, from the minimum, that a correction leaves."""
    noise = np.random.default_rng(0).normal(size=minimum.size)
    in_space = correction(problem, minimum + 1e-5 * noise, w)
    undone = correction(problem, minimum + in_space, w)
    undone -= correction(problem, minimum, w)
    return float(np.linalg.norm(undone - in_space) / np.linalg.norm(in_space))


def test_corrections_are_newton_steps_for_motions_of_the_patches(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    """A step in their space, from the minimum, is undone: B is nearly the inverse of V^T H V.

    The shift of the Hessian leaves a tenth; a shift of 1e-4 would leave 0.005.
    """
    assert left_by_correction(problem, solved.displacements[0], wanted[0]) < 0.15


def test_bending_that_the_scalar_matrix_mistakes_for_stiff_is_undone_at_once(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    """Eight steps from a shape that is bent a little more than that of least energy."""
    w, minimum = wanted[0], solved.displacements[0]
    bending = problem.registered(solved.displacements[1:2])[0] - minimum
    start = minimum + 0.02 * bending
    basis, inverses = without_patches(problem, 1)
    coarse = core.CoarseSpace(problem.system, np.ascontiguousarray(basis.T))

    def energy_left(inputs: FloatArray, space: core.CoarseSpace | None) -> float:
        batch = problem.system.solve_fast(
            inputs[None], start[None], control=core.SolveControl(), coarse=space, **EIGHT
        )
        reached, least, first = (
            problem.system.value_and_gradient(shape, w)[0]
            for shape in (batch.shapes[0], minimum, start)
        )
        return float((reached - least) / (first - least))

    assert energy_left(w, None) < 1e-4
    assert energy_left(np.append(w, inverses), coarse) > 0.01


def test_solves_end_at_the_same_minima_in_far_fewer_evaluations(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    basis, inverses = without_patches(problem, len(wanted))
    starts = np.repeat((problem.tau - problem.base)[None], len(wanted), axis=0)
    plain = solve_snapshots(
        problem, wanted, options=TIGHT, predictions=Predictions(starts, basis, inverses)
    )
    patched = solve_snapshots(problem, wanted, options=TIGHT, predictions=Predictions(starts))
    mass, tau = problem.mass(), problem.tau
    for shape, other, expected in zip(patched.shapes, solved.shapes, plain.shapes, strict=True):
        size = mass_norm(mass, expected - tau)
        assert mass_norm(mass, shape - expected) < 1e-3 * size
        assert mass_norm(mass, other - shape) < 1e-4 * size
    evaluations = [
        np.mean([report.evaluations for report in run.reports]) for run in (patched, plain)
    ]
    assert evaluations[0] < 0.5 * evaluations[1]


def test_neither_threads_nor_blocks_change_a_bit(
    problem: InterpolationProblem, wanted: FloatArray
) -> None:
    one, two, three = (
        solve_snapshots(problem, wanted, options=SolverOptions(block=block), threads=threads)
        for block, threads in ((9, 1), (9, 2), (9, 3))
    )
    assert_same_bits(two, one)
    assert_same_bits(three, one)


def test_turned_poses_take_as_many_evaluations(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    """Motions are those of the shape, in any frame of the same diagonal."""
    other = rolled_strips(turn=np.eye(3)[[2, 0, 1]])
    assert other.system.patches == problem.system.patches
    again = solve_snapshots(other, wanted, options=TIGHT)
    for report, expected in zip(again.reports, solved.reports, strict=True):
        assert report.value == pytest.approx(expected.value, rel=1e-6)
        assert abs(report.evaluations - expected.evaluations) <= 0.4 * expected.evaluations


def test_extrapolated_blends_converge(problem: InterpolationProblem) -> None:
    """Parts of negative weight soften the others."""
    outside = rolled_strips(extrapolation=0.5)
    weights = np.array([[1.1, -0.1, 0.0], [0.55, 0.57, -0.12], [-0.1, 0.4, 0.7]])
    solved = solve_snapshots(outside, weights, options=TIGHT)
    assert solved.converged.all()
    for shape, w in zip(solved.displacements, weights, strict=True):
        value, gradient = outside.system.value_and_gradient(shape, w)
        assert np.linalg.norm(gradient) < 1e-4 * abs(value)


@pytest.mark.parametrize("size", [(2, 2), (3, 2), (5, 4)])
def test_surfaces_of_a_few_triangles_have_patches_that_hardly_turn(size: tuple[int, int]) -> None:
    flat = sheet(*size, thickness=0.1)
    bent = ShellMesh(
        rolled(flat.vertices, 1.0, 0.0).reshape(-1, 3), flat.triangles, thickness=flat.thickness
    )
    problem = InterpolationProblem([flat, bent])
    assert 0 < problem.system.patches <= len(flat.vertices)
    solved = solve_snapshots(problem, [[0.3, 0.7], [0.8, 0.2]], options=TIGHT)
    assert solved.converged.all()


def test_a_polish_ends_near_the_full_solution_in_ten_iterations(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    """The subspace contains neither these blends nor their relaxation; the patches do."""
    few = solved.select(np.arange(len(solved)) < 4)
    session = reduce(problem, snapshot_pca(few, dimension=3), snapshots=few).session()
    mass = session.model.subspace.mass
    for w, shape in zip(wanted[4:], solved.shapes[4:], strict=True):
        session.reset()
        session.blend(w)
        frame = session.vertices.reshape(-1)
        before = mass_norm(mass, problem.aligned(frame, shape) - shape)
        result = session.polish(iterations=10).vertices.reshape(-1)
        assert mass_norm(mass, problem.aligned(result, shape) - shape) < 0.2 * before


def test_other_energies_have_none() -> None:
    assert rolled_strips(material=StableNeoHookean()).system.patches == 0
