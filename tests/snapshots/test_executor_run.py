"""Snapshots of an executor are bitwise those of a local run, and no finished sample is lost."""

from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import pytest

from snapspace import (
    Checkpoint,
    Interrupted,
    PosingProblem,
    Snapshots,
    SolveProgress,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.problem import solver_traits
from snapspace.snapshots import SOLVERS, executor_backend, run
from snapspace.snapshots.solver_options import Solver

from ..shapes import interpolation_problem
from .bars import assert_same_bits, parameters, posing_bar
from .conftest import WORKERS_PATIENCE

PATIENCE = 20.0  # seconds that a test waits for a thread before it fails


@pytest.fixture(params=["threads", "processes"])
def executor(request: pytest.FixtureRequest) -> Iterator[Executor]:
    if request.param == "processes":
        yield request.getfixturevalue("processes")
        return
    with ThreadPoolExecutor(3) as pool:
        yield pool


@pytest.fixture(scope="module")
def posing() -> PosingProblem:
    return posing_bar(bound=0.7)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("block", [3, 16])
def test_an_executor_gives_bitwise_the_results_of_this_machine(
    executor: Executor, posing: PosingProblem, solver: Solver, block: int
) -> None:
    samples = parameters(posing, 25)
    options = SolverOptions(solver=solver, block=block)
    here = solve_snapshots(posing, samples, options=options, threads=2)
    there = solve_snapshots(posing, samples, options=options, executor=executor)
    assert_same_bits(there, here)


@pytest.mark.parametrize("solver", SOLVERS)
def test_samples_between_poses_are_bitwise_the_same_beyond_the_patience(
    executor: Executor, monkeypatch: pytest.MonkeyPatch, solver: Solver
) -> None:
    monkeypatch.setattr(solver_traits, "PATIENCE", WORKERS_PATIENCE)
    problem, options = interpolation_problem(), SolverOptions(solver=solver, block=3)
    samples = sample(problem.domain, 10, seed=1)
    here = solve_snapshots(problem, samples, options=options, threads=2)
    assert here.converged.all()
    if solver == "fast":
        assert max(report.iterations for report in here.reports) > 2 * WORKERS_PATIENCE
    there = solve_snapshots(problem, samples, options=options, executor=executor)
    assert_same_bits(there, here)


def test_a_run_may_change_between_executors(
    executor: Executor, posing: PosingProblem, tmp_path: Path
) -> None:
    """Its checkpoint does not depend on the executor that solved the samples."""
    samples, options = parameters(posing, 25), SolverOptions(block=4)
    whole, part = Checkpoint(tmp_path / "whole"), Checkpoint(tmp_path / "part")
    here = solve_snapshots(posing, samples, options=options, threads=1, checkpoint=whole)
    rows = whole.load()
    kept = [0, 2, 3, 5, 8, 9, 10, 11, 20]
    part.save(kept, [rows[i][0] for i in kept], [rows[i][1] for i in kept])
    there = solve_snapshots(posing, samples, options=options, executor=executor, checkpoint=part)
    assert_same_bits(there, here)


def test_the_executor_is_not_shut_down(executor: Executor, posing: PosingProblem) -> None:
    solve_snapshots(posing, parameters(posing, 3), executor=executor)
    assert executor.submit(int, 5).result(PATIENCE) == 5


def test_progress_is_reported_as_in_local_runs(executor: Executor, posing: PosingProblem) -> None:
    states: list[SolveProgress] = []
    options = SolverOptions(solver="newton", block=5)
    solve_snapshots(
        posing,
        parameters(posing, 15),
        options=options,
        executor=executor,
        progress=states.append,
    )
    done = [state.done for state in states]
    assert done == sorted(done) and {0, 5, 10, 15} <= set(done)
    assert states[-1].eta == 0.0 and states[-1].held_out_error is not None


def test_ctrl_c_keeps_finished_samples_of_tasks(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A block may be hours of work, and partly finished when Ctrl-C comes."""
    controls: list[core.SolveControl] = []

    def control() -> core.SolveControl:
        controls.append(core.SolveControl())
        return controls[-1]

    monkeypatch.setattr(executor_backend, "core", SimpleNamespace(SolveControl=control))
    monkeypatch.setattr(run, "POLL_SECONDS", 0.002)
    problem = posing_bar(12, 3, 3, bound=0.7)
    samples = parameters(problem, 40)
    options = SolverOptions(solver="newton", block=20)
    begin = time.monotonic()

    def ctrl_c(state: SolveProgress) -> None:
        assert time.monotonic() < begin + PATIENCE
        if controls[0].finished >= 3:
            assert state.done == 0, "the block is not finished"
            raise KeyboardInterrupt

    checkpoint = Checkpoint(tmp_path / "run")
    with ThreadPoolExecutor(1) as pool:
        with pytest.raises(Interrupted):
            solve_snapshots(
                problem,
                samples,
                options=options,
                executor=pool,
                progress=ctrl_c,
                checkpoint=checkpoint,
            )
        assert 3 <= len(checkpoint.numbers()) < 20
        resumed = solve_snapshots(
            problem, samples, options=options, executor=pool, checkpoint=checkpoint
        )
    assert_same_bits(resumed, solve_snapshots(problem, samples, options=options, threads=1))


def test_an_error_of_a_worker_keeps_finished_samples(
    monkeypatch: pytest.MonkeyPatch, posing: PosingProblem, tmp_path: Path
) -> None:
    class Failing(ThreadPoolExecutor):
        """Accepts only three blocks."""

        accepted = 0

        def submit(self, *args, **kwargs):  # type: ignore[no-untyped-def]
            self.accepted += 1
            if self.accepted > 3:
                raise RuntimeError("cannot schedule new futures after shutdown")
            return super().submit(*args, **kwargs)

    samples, options = parameters(posing, 24), SolverOptions(solver="newton", block=4)
    checkpoint = Checkpoint(tmp_path / "run")
    with Failing(1) as pool, pytest.raises(ValueError, match="does not accept samples 12 to 15"):
        solve_snapshots(posing, samples, options=options, executor=pool, checkpoint=checkpoint)
    assert checkpoint.numbers() == set(range(12))
    resumed: Snapshots = solve_snapshots(
        posing, samples, options=options, threads=1, checkpoint=checkpoint
    )
    assert_same_bits(resumed, solve_snapshots(posing, samples, options=options, threads=1))
