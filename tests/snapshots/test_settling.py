"""The stopping test on shapes: the error that it leaves, and its cost on finer meshes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    PosingProblem,
    Snapshots,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace.mesh import mass_norms
from snapspace.snapshots.solver_options import SETTLED_TOLERANCE

from .creatures import posing_creature
from .effort import evaluations

SAMPLES = 24


def solved(problem: PosingProblem, **options: Any) -> Snapshots:
    """Solves all samples from rest, so that they do not help each other."""
    samples = sample(problem.domain, SAMPLES, method="sobol", seed=3)
    solver = SolverOptions(block=SAMPLES, **options)
    return solve_snapshots(problem, samples, options=solver, threads=1)


def errors(snapshots: Snapshots, limit: Snapshots) -> NDArray[np.float64]:
    """Errors in the M-norm, relative to the displacement."""
    mass, rest = limit.problem.mass(), limit.problem.base
    misses: NDArray[np.float64] = mass_norms(mass, snapshots.shapes - limit.shapes)
    return misses / mass_norms(mass, limit.shapes - rest)


@pytest.fixture(scope="module")
def small() -> PosingProblem:
    return posing_creature(5_000)


def test_settling_bounds_the_error(small: PosingProblem) -> None:
    """Each direction estimates the distance. Soft shapes are further away, by a factor that does
    not depend on the test, and a tighter test leaves a smaller error."""
    limit = solved(small, tolerance=1e-12)
    settlings = np.array([0.01, 0.003, 0.001])
    left = np.array([np.median(errors(solved(small, settling=s), limit)) for s in settlings])
    assert (np.diff(left) < 0).all()
    assert (left < 6.0 * settlings).all()


def test_the_cost_of_settling_depends_less_on_the_mesh(small: PosingProblem) -> None:
    """The energy of a finer mesh continues to fall after its shape has settled."""
    large = posing_creature(30_000)
    settled, by_energy = (
        evaluations(solved(large, **how)) / evaluations(solved(small, **how))
        for how in ({"settling": 2e-3}, {"tolerance": 1e-6})
    )
    assert settled < 0.95 * by_energy


def test_a_tolerance_alone_tests_only_the_energy(small: PosingProblem) -> None:
    """A run with a given tolerance is bitwise the same as one without the other test."""
    assert SolverOptions(tolerance=1e-7).resolved(small).settling == 0.0
    given, never = solved(small, tolerance=1e-7), solved(small, tolerance=1e-7, settling=0.0)
    assert np.array_equal(given.shapes, never.shapes)


def test_samples_at_rest_are_done_at_once(small: PosingProblem) -> None:
    """A share of no displacement is zero."""
    at_rest = solve_snapshots(small, np.zeros((3, 6)), threads=1)
    assert at_rest.converged.all()
    assert evaluations(at_rest) <= 2


def test_both_tests_may_be_given(small: PosingProblem) -> None:
    resolved = SolverOptions(tolerance=1e-4, settling=0.01).resolved(small)
    assert (resolved.tolerance, resolved.settling) == (1e-4, 0.01)
    either = evaluations(solved(small, tolerance=1e-4, settling=0.01))
    assert either <= min(
        evaluations(solved(small, tolerance=1e-4)), evaluations(solved(small, settling=0.01))
    )


def test_newton_uses_only_the_tolerance(small: PosingProblem) -> None:
    resolved = SolverOptions(solver="newton").resolved(small)
    assert resolved.settling == 0.0
    assert resolved.tolerance == small.solving.tolerance > SETTLED_TOLERANCE


@pytest.mark.parametrize("bad", [-0.1, np.nan, np.inf])
def test_bad_settling(bad: float) -> None:
    with pytest.raises(ValueError, match=r"settling is .*, but it must be zero or positive"):
        SolverOptions(settling=bad)


def test_a_run_does_not_wait_long_for_the_slowest(small: PosingProblem) -> None:
    """The share grows with the iterations, because a few samples crawl along flat valleys."""
    counts = [
        report.evaluations for report in solved(small, settling=3e-4, soft_modes=False).reports
    ]
    assert max(counts) < 2.0 * np.median(counts)
