"""A pickled problem is the same problem, and the pickle holds only what defines it."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationProblem, Poses, solve_snapshots
from snapspace.problem import Problem
from snapspace.sampling import sample

from ..shapes import bar_poses, bar_problem, interpolation_problem, symmetric_bar

FloatArray = NDArray[np.float64]


def unpickled(problem: Any) -> Any:
    return pickle.loads(pickle.dumps(problem))


@pytest.mark.parametrize("make", [bar_problem, interpolation_problem])
def test_it_is_the_same_problem_and_solves_to_the_same_bits(make: Any) -> None:
    problem: Problem = make()
    parameters = sample(problem.domain, 3, seed=1)
    expected = solve_snapshots(problem, parameters, threads=1)
    copy = unpickled(problem)
    assert copy.fingerprint == problem.fingerprint
    assert type(copy) is type(problem)
    assert repr(copy) == repr(problem)
    found = solve_snapshots(copy, parameters, threads=1)
    np.testing.assert_array_equal(found.shapes, expected.shapes)


@pytest.mark.parametrize("make", [bar_problem, interpolation_problem])
def test_a_used_problem_is_no_larger_than_a_fresh_one(make: Any) -> None:
    """Factors and other caches stay behind; they are many times the size of the mesh."""
    used, fresh = make(), make()
    for problem in (used, fresh):
        _ = problem.tau
    parameters = sample(used.domain, 2, seed=1)
    solve_snapshots(used, parameters, threads=1)
    _ = used.fingerprint, used.mass()
    assert len(pickle.dumps(used)) == len(pickle.dumps(fresh))


def test_a_known_mean_shape_is_pickled_and_an_unknown_one_is_not_solved_for() -> None:
    problem = interpolation_problem()
    assert "mean_shape" not in vars(unpickled(problem))
    mean = problem.mean_shape
    np.testing.assert_array_equal(vars(unpickled(problem))["mean_shape"], mean)
    # a given mean shape need not be the solution
    given = InterpolationProblem(bar_poses(), mean_shape=problem.poses.shapes[1])
    np.testing.assert_array_equal(unpickled(given).tau, given.tau)


def test_options_are_pickled() -> None:
    mesh = symmetric_bar()
    mirrored = mesh.vertices * [1.0, -1.0, 1.0]
    poses = Poses(
        [mesh.vertices, mirrored], mesh.tets, names=["right", "left"], accept_inverted=True
    )
    copy = unpickled(InterpolationProblem(poses, extrapolation=0.2))
    assert copy.poses.names == ("right", "left")
    assert copy.poses.inverted_tets.tolist() == [0, len(mesh.tets)]
    assert copy.domain.extrapolation == 0.2
    posing = bar_problem(stiffness=7.0)
    assert unpickled(posing).handles.names == posing.handles.names
    assert unpickled(posing).domain == posing.domain
    assert (unpickled(posing).stiffness, unpickled(posing).material) == (7.0, posing.material)


def test_unpickled_arrays_are_read_only() -> None:
    problem = unpickled(bar_problem())
    for array in (problem.mesh.vertices, problem.handles["head"].vertices):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    with pytest.raises(ValueError, match="read-only"):
        unpickled(interpolation_problem()).poses.shapes[0] = 0.0
