"""The mean shape: given by the caller, or solved for on any number of threads."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import InterpolationProblem
from snapspace.generators import cylinder, helix
from snapspace.problem import interpolation_problem as module

from ..shapes import bar_poses, interpolation_problem


def test_a_given_mean_shape_is_copied() -> None:
    """Later changes to the caller's array must not reach solutions or the subspace."""
    given = interpolation_problem().tau.copy()
    wanted = given.copy()
    problem = InterpolationProblem(bar_poses(), mean_shape=given)
    given += 1.0
    np.testing.assert_array_equal(problem.tau, wanted)
    np.testing.assert_array_equal(problem.mean_shape, wanted)
    vertices = wanted.reshape(-1, 3).copy()
    problem = InterpolationProblem(bar_poses(), mean_shape=vertices)
    vertices[:] = 0.0
    np.testing.assert_array_equal(problem.tau, wanted)


def test_threads_do_not_change_a_bit() -> None:
    shapes = []
    for threads in (1, 2, None):
        problem = InterpolationProblem([cylinder(2, 14), helix(2, 14)])
        problem.solve_mean_shape(threads=threads)
        shapes.append(problem.mean_shape)
    unasked = InterpolationProblem([cylinder(2, 14), helix(2, 14)]).mean_shape
    for shape in (*shapes[1:], unasked):
        np.testing.assert_array_equal(shape, shapes[0])


def test_a_mean_shape_that_is_known_is_not_solved_for_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    threads_used: list[int] = []
    solve = module.mean_displacement

    def watched(*arrays: object, threads: int) -> object:
        threads_used.append(threads)
        return solve(*arrays, threads=threads)  # type: ignore[arg-type]

    monkeypatch.setattr(module, "mean_displacement", watched)
    problem = interpolation_problem()
    problem.solve_mean_shape(threads=1)
    first = problem.mean_shape
    problem.solve_mean_shape(threads=2)
    assert problem.mean_shape is first
    given = InterpolationProblem(bar_poses(), mean_shape=first)
    given.solve_mean_shape()
    np.testing.assert_array_equal(given.mean_shape, first)
    assert threads_used == [1]
