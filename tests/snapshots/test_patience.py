"""A sample that uses up the problem's patience continues alone, with its own factor."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    InterpolationProblem,
    SampleReport,
    SolveProgress,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.problem import solver_traits
from snapspace.snapshots.fast_solve import solve_fast

from ..shapes import interpolation_problem
from .bars import assert_same_bits, without_seconds
from .blocks import OPTIONS

FloatArray = NDArray[np.float64]
PATIENCE = 17  # iterations; the samples below need 40 to 50

Solution = tuple[FloatArray, list[SampleReport]]


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return interpolation_problem(extrapolation=0.3)


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solver_traits, "PATIENCE", PATIENCE)


def weights(problem: InterpolationProblem, count: int = 9) -> FloatArray:
    return sample(problem.domain, count, seed=3)


def solved(
    problem: InterpolationProblem, samples: FloatArray, *, max_iterations: int = 1000
) -> Solution:
    """The samples, solved from the mean shape."""
    starts = np.repeat((problem.tau - problem.base)[None], len(samples), axis=0)
    options = replace(OPTIONS, tolerance=1e-11, max_iterations=max_iterations)
    return solve_fast(problem, samples, starts, core.SolveControl(), options, threads=1)


def solved_patiently(problem: InterpolationProblem, samples: FloatArray) -> Solution:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solver_traits, "PATIENCE", 0)
        return solved(problem, samples)


def counted(reports: list[SampleReport]) -> list[tuple[str, int, int, float, float]]:
    return [(r.status, r.iterations, r.evaluations, r.value, r.gradient_norm) for r in reports]


class Spy:
    """A `system_near` that records the shapes of its calls and the reports of its systems."""

    def __init__(self, problem: InterpolationProblem) -> None:
        self._problem = problem
        self.shapes: list[FloatArray] = []
        self.reports: list[core.SolveReport] = []

    def __call__(self, displacement: FloatArray) -> Any:
        self.shapes.append(displacement.copy())
        system = self._problem._rest_system.adapted(
            displacement[None], self._problem.domain.center[None]
        )

        def solve(*arrays: FloatArray, **options: Any) -> core.Batch:
            batch = system.solve_fast(*arrays, **options)
            self.reports += batch.reports
            return batch

        return SimpleNamespace(solve_fast=solve)


@pytest.fixture
def spy(problem: InterpolationProblem, monkeypatch: pytest.MonkeyPatch) -> Spy:
    watch = Spy(problem)
    _ = problem.system  # the same method makes it
    monkeypatch.setattr(InterpolationProblem, "_system_near", lambda _, shape: watch(shape))
    return watch


@pytest.mark.usefixtures("impatient")
def test_the_minimum_is_that_of_a_patient_solve(problem: InterpolationProblem) -> None:
    samples = weights(problem)
    shapes, reports = solved(problem, samples)
    wanted, patient = solved_patiently(problem, samples)
    assert all(r.status == "converged" and r.iterations > PATIENCE for r in reports)
    for report, reference in zip(reports, patient, strict=True):
        assert report.value == pytest.approx(reference.value, rel=1e-8)
    np.testing.assert_allclose(
        problem.registered(shapes),
        problem.registered(wanted),
        rtol=0,
        atol=1e-4 * problem.mesh.diagonal,
    )


@pytest.mark.usefixtures("impatient")
def test_a_report_covers_all_tries(problem: InterpolationProblem, spy: Spy) -> None:
    """Each factor is made for the shape reached; iterations and evaluations are summed."""
    samples = weights(problem)[:1]
    _, (report,) = solved(problem, samples)
    first = solved(problem, samples, max_iterations=PATIENCE)
    np.testing.assert_array_equal(spy.shapes[0], first[0][0])
    assert len(spy.shapes) == len(spy.reports) >= 2
    parts = [*first[1], *spy.reports]
    assert report.iterations == sum(part.iterations for part in parts)
    assert report.evaluations == sum(part.evaluations for part in parts)
    last = spy.reports[-1]
    assert (report.status, report.value) == (last.status.name, last.value)
    assert report.gradient_norm == last.gradient_norm


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("most", [5, PATIENCE, PATIENCE + 1, 2 * PATIENCE + 3])
def test_no_more_iterations_than_allowed(
    problem: InterpolationProblem, spy: Spy, most: int
) -> None:
    samples = weights(problem, 3)
    _, reports = solved(problem, samples, max_iterations=most)
    assert [(r.status, r.iterations) for r in reports] == [("max_iterations", most)] * 3
    assert len(spy.shapes) == 3 * ((most - 1) // PATIENCE)


@pytest.mark.usefixtures("impatient")
def test_a_slow_sample_does_not_see_its_neighbours(problem: InterpolationProblem) -> None:
    samples = weights(problem)
    shapes, reports = solved(problem, samples)
    for which in ([8, 1, 4, 0], [3], [2, 7]):
        some, some_reports = solved(problem, samples[which])
        np.testing.assert_array_equal(some, shapes[which])
        assert counted(some_reports) == [counted(reports)[k] for k in which]


@pytest.mark.usefixtures("impatient")
def test_threads_do_not_change_a_bit(problem: InterpolationProblem) -> None:
    """The counts that are shown never exceed the total."""
    samples, shown = weights(problem, 14), [0]
    options = SolverOptions(block=9)

    def show(state: SolveProgress) -> None:
        shown.append(state.done)

    one = solve_snapshots(problem, samples, options=options, threads=1)
    two = solve_snapshots(problem, samples, options=options, threads=2, progress=show)
    assert one.converged.all()
    assert min(report.iterations for report in without_seconds(one)) > PATIENCE
    assert_same_bits(two, one)
    assert max(shown) == len(samples)


def cancelled_after_the_first_try(samples: FloatArray) -> tuple[Solution, Spy]:
    """The solution if Ctrl-C comes when all samples have used up their patience."""
    problem, control = interpolation_problem(extrapolation=0.3), core.SolveControl()
    system, spy = problem.system, Spy(problem)

    def solve(*arrays: FloatArray, **options: Any) -> core.Batch:
        batch = system.solve_fast(*arrays, **options)
        control.cancel()
        return batch

    problem.__dict__.update(system=SimpleNamespace(solve_fast=solve), _system_near=spy)
    starts = np.repeat((problem.tau - problem.base)[None], len(samples), axis=0)
    starts[0] = problem.pose_shapes[1] - problem.base
    options = replace(OPTIONS, tolerance=1e-9)
    return solve_fast(problem, samples, starts, control, options, threads=1), spy


@pytest.mark.usefixtures("impatient")
def test_ctrl_c_cancels_slow_samples_without_another_factor(problem: InterpolationProblem) -> None:
    samples = np.vstack([[0.0, 1.0, 0.0], weights(problem, 4)])
    (_, reports), spy = cancelled_after_the_first_try(samples)
    # the first sample starts at its solution, a pose, and is finished
    assert [report.status for report in reports] == ["converged", *["cancelled"] * 4]
    assert [report.iterations for report in reports[1:]] == [PATIENCE] * 4
    assert spy.shapes == []


@pytest.mark.usefixtures("impatient")
def test_ctrl_c_during_a_second_try_makes_no_third(
    problem: InterpolationProblem, monkeypatch: pytest.MonkeyPatch
) -> None:
    control, spy = core.SolveControl(), Spy(problem)
    _ = problem.system

    def near(_: InterpolationProblem, displacement: FloatArray) -> Any:
        if len(spy.shapes) == 1:  # the first slow sample has continued with one factor
            control.cancel()
        return spy(displacement)

    monkeypatch.setattr(InterpolationProblem, "_system_near", near)
    starts = np.repeat((problem.tau - problem.base)[None], 5, axis=0)
    options = replace(OPTIONS, tolerance=1e-9)
    _, reports = solve_fast(problem, weights(problem, 5), starts, control, options, threads=1)
    assert [report.status for report in reports] == ["cancelled"] * 5
    assert len(spy.shapes) == 2
