"""Both solvers find the minimiser of F: compared with each other, SciPy and the gradient."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from snapspace import PosingProblem, Snapshots, SolverOptions, solve_snapshots
from snapspace.snapshots import SOLVERS
from snapspace.snapshots.solver_options import Solver

from .bars import parameters, posing_bar, tight

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    return posing_bar()


@pytest.fixture(scope="module")
def samples(problem: PosingProblem) -> FloatArray:
    return parameters(problem, 8)


@pytest.fixture(scope="module")
def minimisers(problem: PosingProblem, samples: FloatArray) -> Snapshots:
    """Newton's minimisers. No singular value reaches the clamp, so its Hessian is the true one."""
    found = solve_snapshots(problem, samples, options=tight("newton"), threads=1)
    assert found.converged.all()
    assert max(report.inverted_tets for report in found.reports) == 0
    return found


def values(snapshots: Snapshots) -> FloatArray:
    return np.array([report.value for report in snapshots.reports])


def error(snapshots: Snapshots, limit: Snapshots) -> FloatArray:
    """Distances from the limit, relative to the displacement from rest."""
    rest = limit.problem.mesh.vertices.reshape(-1)
    distance = np.linalg.norm(snapshots.shapes - limit.shapes, axis=1)
    relative: FloatArray = distance / np.linalg.norm(limit.shapes - rest, axis=1)
    return relative


def test_fast_and_newton_find_the_same_shapes(minimisers: Snapshots) -> None:
    problem, samples = minimisers.problem, minimisers.parameters
    fast = solve_snapshots(problem, samples, options=tight("fast"), threads=1)
    assert fast.converged.all()
    np.testing.assert_allclose(values(fast), values(minimisers), rtol=1e-12)
    assert error(fast, minimisers).max() < 1e-7


@pytest.mark.parametrize("stiffness", [1.0, 1e6])
def test_fast_and_newton_agree_for_soft_and_hard_handles(stiffness: float) -> None:
    problem = posing_bar(stiffness=stiffness)
    samples = parameters(problem, 4)
    fast, newton = (
        solve_snapshots(problem, samples, options=tight(solver), threads=1) for solver in SOLVERS
    )
    assert fast.converged.all() and newton.converged.all()
    np.testing.assert_allclose(values(fast), values(newton), rtol=1e-11)
    assert error(fast, newton).max() < 1e-6


@pytest.mark.parametrize("method", ["Newton-CG", "L-BFGS-B"])
def test_scipy_finds_the_same_shapes(minimisers: Snapshots, method: str) -> None:
    """SciPy starts at rest, with F assembled in NumPy, and uses no code of the solvers."""
    problem = minimisers.problem
    pull = np.zeros(problem.mesh.vertices.shape)
    pull[problem.pinned] = 2.0 * problem.pin_weights[:, None]

    def hessian_product(x: FloatArray, v: FloatArray, w: FloatArray) -> FloatArray:
        return problem.energy.hessian_product(x, v) + pull.reshape(-1) * v

    methods: dict[str, dict[str, Any]] = {
        "Newton-CG": {"hessp": hessian_product, "options": {"xtol": 1e-12}},
        "L-BFGS-B": {"options": {"maxiter": 20_000, "maxfun": 20_000, "ftol": 0.0, "gtol": 1e-10}},
    }
    for row in range(2):
        found = minimize(
            problem.value_and_gradient,
            problem.mesh.vertices.reshape(-1),
            args=(minimisers.parameters[row],),
            jac=True,
            method=method,
            **methods[method],
        )
        np.testing.assert_allclose(minimisers.reports[row].value, found.fun, rtol=1e-12)
        np.testing.assert_allclose(minimisers.shapes[row], found.x, rtol=0, atol=1e-6)


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_force_is_left(problem: PosingProblem, samples: FloatArray, solver: Solver) -> None:
    """Elastic and handle forces balance to 1e-6 of either, by the problem's own gradient."""
    solved = solve_snapshots(problem, samples, options=tight(solver), threads=1)
    for w, x, report in zip(samples, solved.shapes, solved.reports, strict=True):
        value, gradient = problem.value_and_gradient(x, w)
        _, elastic = problem.energy.value_and_gradient(x)
        left, scale = float(np.linalg.norm(gradient)), float(np.linalg.norm(elastic))
        assert left < 1e-6 * scale
        assert report.value == pytest.approx(value, rel=1e-12)
        assert report.gradient_norm == pytest.approx(
            left, abs=1e-9 * float(np.linalg.norm(elastic))
        )


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_tighter_tolerance_is_nearer_to_the_limit(minimisers: Snapshots, solver: Solver) -> None:
    """The tolerance bounds the excess of F relative to F."""
    errors = []
    for tolerance in 10.0 ** np.arange(-2, -11, -2):
        # one block: warm starts would bring in the tolerance of other samples
        options = SolverOptions(solver=solver, tolerance=tolerance, block=8)
        solved = solve_snapshots(
            minimisers.problem, minimisers.parameters, options=options, threads=1
        )
        assert (values(solved) / values(minimisers) - 1.0).max() < tolerance
        errors.append(error(solved, minimisers))
    # a Newton step may meet two tolerances at once, for one sample or another
    assert (np.diff(errors, axis=0) <= 0).all()
    assert (np.diff(np.mean(errors, axis=1)) < 0).all()
    assert errors[-1].max() < 1e-5


def decrements(problem: PosingProblem, w: FloatArray) -> list[float]:
    """Relative decrement after each of Newton's steps, from rest."""
    sequence = []
    for bound in range(1, 12):
        options = SolverOptions(solver="newton", tolerance=1e-14, max_iterations=bound)
        report = solve_snapshots(problem, w[None], options=options, threads=1).reports[0]
        sequence.append(report.decrement / report.value)
        if report.converged:
            return sequence
        assert report.iterations == bound
    raise AssertionError(f"not converged: {sequence}")


def test_newton_is_superlinear_near_the_minimum(problem: PosingProblem) -> None:
    """Every decrement below 1 % is followed by one smaller than its 1.3rd power."""
    for w in parameters(problem, 4):
        sequence = decrements(problem, w)
        near = [d for d in sequence if d < 1e-2]
        assert len(near) >= 3
        assert all(following < d**1.3 for d, following in itertools.pairwise(near)), near


def test_nine_decades_take_newton_few_steps(minimisers: Snapshots) -> None:
    """Linear convergence at the first rate would take three times the steps, as L-BFGS does."""
    loose = SolverOptions(solver="newton", tolerance=1e-4, block=8)
    tighter = SolverOptions(solver="newton", tolerance=1e-13, block=8)
    few, more = (
        [r.iterations for r in solve_snapshots(minimisers.problem, minimisers.parameters,
                                               options=options, threads=1).reports]
        for options in (loose, tighter)
    )  # fmt: skip
    assert max(np.subtract(more, few)) <= 3


@pytest.mark.parametrize("clamp", [0.5, 0.8, 1.0])
def test_the_clamp_changes_the_path_and_not_the_minimum(
    minimisers: Snapshots, clamp: float
) -> None:
    options = SolverOptions(solver="newton", tolerance=1e-13, clamp=clamp)
    solved = solve_snapshots(
        minimisers.problem, minimisers.parameters[:3], options=options, threads=1
    )
    assert solved.converged.all()
    np.testing.assert_allclose(values(solved), values(minimisers)[:3], rtol=1e-12)


def test_warm_starts_change_iterations_not_energies(minimisers: Snapshots) -> None:
    problem = minimisers.problem
    samples = parameters(problem, 96)
    cold, warm = (
        solve_snapshots(
            problem, samples, options=SolverOptions(tolerance=1e-10, block=block), threads=1
        )
        for block in (96, 12)
    )
    # the first two blocks wait for no other block
    np.testing.assert_array_equal(cold.shapes[:24], warm.shapes[:24])
    np.testing.assert_allclose(values(warm), values(cold), rtol=1e-10)
    # the last three have 27 starts or more; fewer do not improve a bar's good guesses
    iterations = [[r.iterations for r in s.reports[60:]] for s in (cold, warm)]
    assert np.mean(iterations[1]) < 0.97 * np.mean(iterations[0])
