"""Rigid motions of patches in the seed of blends of solids."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    Corotational,
    InterpolationProblem,
    Material,
    Poses,
    Predictions,
    Snapshots,
    SolverOptions,
    StableNeoHookean,
    sample,
    solve_snapshots,
)
from snapspace.generators import lizard_poses
from snapspace.mesh import mass_norm

from ..taylor import observed_order
from .bars import assert_same_bits
from .test_patches import TIGHT, left_by_correction, without_patches

FloatArray = NDArray[np.float64]


def lizards(
    tets: int, material: Material | None = None, *, poses: int = 3, extrapolation: float = 0.0
) -> InterpolationProblem:
    return InterpolationProblem(
        Poses.of(lizard_poses(poses, tets, seed=3)),
        material=material or StableNeoHookean(),
        extrapolation=extrapolation,
    )


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return lizards(23_000)


@pytest.fixture(scope="module")
def wanted(problem: InterpolationProblem) -> FloatArray:
    return sample(problem.domain, 4, seed=5)


@pytest.fixture(scope="module")
def solved(problem: InterpolationProblem, wanted: FloatArray) -> Snapshots:
    return solve_snapshots(problem, wanted, options=TIGHT)


@pytest.mark.parametrize("weights", [[1.0, 0.0, 0.0], [0.2, 0.5, 0.3], [0.6, 0.7, -0.3]])
def test_hessians_of_tets_are_derivatives_of_their_stresses(weights: list[float]) -> None:
    small = lizards(500)
    system, w = small.system, np.array(weights)
    rng = np.random.default_rng(1)
    u, d = 0.05 * rng.normal(size=(2, small.base.size))
    corners = small.base.reshape(-1, 3)[small.mesh.cells]
    steps = d.reshape(-1, 3)[small.mesh.cells]
    edges, moved = (np.swapaxes(x[:, 1:] - x[:, :1], 1, 2) for x in (corners, steps))
    gradients = (moved @ np.linalg.inv(edges)).reshape(-1, 9)
    every = np.arange(len(small.mesh.cells), dtype=np.int32)

    def stresses(at: FloatArray) -> FloatArray:
        found: FloatArray = system.some_tet_stresses(at, w, every)[0]
        return found

    before, hessians = stresses(u), system.tet_hessians(u, w)
    changes = np.einsum("tef,tf->te", hessians, gradients)
    order = observed_order(lambda h: stresses(u + h * d) - before - h * changes)
    assert order == pytest.approx(2.0, abs=0.1)
    np.testing.assert_allclose(hessians, np.swapaxes(hessians, 1, 2), atol=1e-12)


def test_corrections_are_nearly_newton_steps_for_motions_of_the_patches(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    """The shift takes part of a step, and so does the sample of tets."""
    assert left_by_correction(problem, solved.displacements[0], wanted[0]) < 0.6


def test_solves_end_nearer_to_the_same_minima_in_fewer_evaluations(
    problem: InterpolationProblem, solved: Snapshots, wanted: FloatArray
) -> None:
    basis, inverses = without_patches(problem, len(wanted))
    starts = np.repeat((problem.tau - problem.base)[None], len(wanted), axis=0)
    options = SolverOptions(tolerance=1e-9)
    plain, patched = (
        solve_snapshots(problem, wanted, options=options, predictions=predictions)
        for predictions in (Predictions(starts, basis, inverses), Predictions(starts))
    )
    mass = problem.mass()
    misses = [
        np.mean([mass_norm(mass, x - y) for x, y in zip(run.shapes, solved.shapes, strict=True)])
        for run in (patched, plain)
    ]
    evaluations = [
        np.mean([report.evaluations for report in run.reports]) for run in (patched, plain)
    ]
    assert misses[0] < 0.7 * misses[1]
    assert evaluations[0] < 0.7 * evaluations[1]


def test_neither_threads_nor_blocks_change_a_bit(
    problem: InterpolationProblem, wanted: FloatArray
) -> None:
    one, three = (
        solve_snapshots(problem, wanted, options=SolverOptions(block=4), threads=threads)
        for threads in (1, 3)
    )
    assert_same_bits(three, one)


def test_extrapolated_blends_converge() -> None:
    """Weights below zero soften what other poses stiffen."""
    outside = lizards(21_000, extrapolation=0.3)
    weights = np.array([[1.1, -0.1, 0.0], [0.55, 0.54, -0.09]])
    assert solve_snapshots(outside, weights, options=SolverOptions(tolerance=1e-9)).converged.all()


def test_small_solids_and_other_densities_have_none(problem: InterpolationProblem) -> None:
    assert 10 <= problem.system.patches <= 32
    assert lizards(2_000).system.patches == 0
    assert lizards(21_000, Corotational(), poses=2)._rest_system.patches == 0
