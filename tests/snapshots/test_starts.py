"""Starts interpolated from known samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.distance import pdist

from snapspace import SolverOptions, sample, solve_snapshots
from snapspace.displacements import DisplacementRows
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver
from snapspace.snapshots.starts import interpolated_start, nearest_start

from .bars import parameters, posing_bar

FloatArray = NDArray[np.float64]


def as_rows(shapes: FloatArray) -> DisplacementRows:
    return DisplacementRows(shapes, shapes.shape[1])


def test_a_nearest_start_is_the_nearest_sample() -> None:
    known = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    shapes = np.arange(12.0).reshape(3, 4)
    wanted = np.array([[0.9, 0.2], [0.1, 0.2], [0.4, 0.6], [0.0, 0.0]])
    found = nearest_start(known, as_rows(shapes), wanted)
    np.testing.assert_array_equal(found, shapes[[1, 0, 2, 0]])


@given(st.integers(0, 1000), st.integers(2, 30), st.integers(1, 12))
def test_interpolation_reproduces_known_samples(seed: int, count: int, dimension: int) -> None:
    rng = np.random.default_rng(seed)
    known, shapes = rng.random((count, dimension)), rng.normal(size=(count, 9))
    found = interpolated_start(known, as_rows(shapes), known)
    # the closer the samples, the larger the numbers that cancel
    closest = pdist(known).min()
    bound = 1e-14 / min(closest, 1.0) ** 2
    if closest > 1e-5:
        bound = min(bound, 1e-6)
    np.testing.assert_allclose(found, shapes, rtol=0, atol=bound)


def test_interpolation_between_equal_shapes_is_that_shape() -> None:
    """The weights of a start sum to one: away from the samples it does not fade towards rest."""
    rng = np.random.default_rng(1)
    shapes = np.tile(rng.normal(size=9), (20, 1))
    starts = interpolated_start(rng.random((20, 6)), as_rows(shapes), rng.random((5, 6)))
    np.testing.assert_allclose(starts, shapes[:5], atol=1e-12)


def test_many_samples_reproduce_linear_functions_of_the_parameters() -> None:
    rng = np.random.default_rng(4)
    known, wanted = rng.random((40, 3)), rng.random((6, 3))
    slopes = rng.normal(size=(3, 9))
    starts = interpolated_start(known, as_rows(known @ slopes + 1.0), wanted)
    np.testing.assert_allclose(starts, wanted @ slopes + 1.0, atol=1e-9)


@pytest.mark.parametrize("thickness", [0.0, 1e-14, 1e-9, 1e-7])
def test_samples_in_a_plane_are_enough(thickness: float) -> None:
    """They may be a path or a slice of the domain; a start off the plane stays near the shapes."""
    rng = np.random.default_rng(5)
    known, wanted = rng.random((40, 3)), rng.random((6, 3))
    known[:, 2] = 0.5 + thickness * rng.normal(size=40)
    shapes = np.hstack([known, np.ones((40, 6))])
    starts = interpolated_start(known, as_rows(shapes), wanted)
    assert np.isfinite(starts).all()
    np.testing.assert_allclose(starts[:, :2], wanted[:, :2], atol=0.5)
    np.testing.assert_allclose(
        starts[:, 2:], np.array([0.5, *[1.0] * 6])[None].repeat(6, 0), atol=0.1
    )


def test_one_known_sample_is_every_start() -> None:
    shapes = np.ones((1, 9))
    starts = interpolated_start(np.full((1, 6), 0.5), as_rows(shapes), np.zeros((3, 6)))
    np.testing.assert_array_equal(starts, np.ones((3, 9)))


def test_repeated_samples_count_once() -> None:
    rng = np.random.default_rng(2)
    known, shapes, wanted = rng.random((8, 6)), rng.normal(size=(8, 9)), rng.random((4, 6))
    twice = interpolated_start(
        np.vstack([known, known[:3]]), as_rows(np.vstack([shapes, shapes[:3]])), wanted
    )
    once = interpolated_start(known, as_rows(shapes), wanted)
    np.testing.assert_allclose(twice, once, atol=1e-12)
    same = np.tile(known[:1], (5, 1))
    one = interpolated_start(same, as_rows(np.tile(shapes[:1], (5, 1))), wanted)
    np.testing.assert_array_equal(one, np.tile(shapes[:1], (4, 1)))


@pytest.mark.parametrize("solver", SOLVERS)
def test_samples_that_repeat_each_other_or_rest_are_solved(solver: Solver) -> None:
    """An unscrambled Sobol sequence contains the rest pose, as every odd grid does."""
    problem = posing_bar()
    samples = sample(problem.domain, 6, method="sobol", scramble=False)
    assert not samples[1].any()
    options = SolverOptions(solver=solver, block=3)
    repeated = np.vstack([samples, samples[[0, 2]]])
    solved = solve_snapshots(problem, repeated, options=options, threads=1)
    assert solved.converged.all()
    np.testing.assert_array_equal(solved.shapes[1], problem.mesh.vertices.reshape(-1))
    np.testing.assert_allclose(solved.shapes[6:], solved.shapes[[0, 2]], atol=0.02)


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_rest_pose_in_a_later_block_converges(solver: Solver) -> None:
    """F vanishes there, as in the middle of an odd grid, so no share of F is ever reached."""
    problem = posing_bar()
    samples = np.vstack([parameters(problem, 8), np.zeros((1, 6))])
    options = SolverOptions(solver=solver, block=4)
    report = solve_snapshots(problem, samples, options=options, threads=1).reports[8]
    assert report.value < 1e-20
    assert report.converged


def test_known_samples_start_where_they_end() -> None:
    """A sample that is repeated in a later block takes no iterations."""
    problem = posing_bar()
    samples = parameters(problem, 8)
    options = SolverOptions(solver="newton", block=8, tolerance=1e-8)
    again = solve_snapshots(problem, np.vstack([samples, samples]), options=options, threads=1)
    assert all(report.iterations == 0 for report in again.reports[8:])
    np.testing.assert_array_equal(again.shapes[8:], again.shapes[:8])
