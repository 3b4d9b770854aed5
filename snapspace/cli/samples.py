"""Where a build's samples come from: given beforehand, or chosen on the way."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..greedy import BATCH, finished_samples, greedy_key, greedy_snapshots
from ..problem import InterpolationProblem, PosingProblem
from ..snapshots import (
    Checkpoint,
    Progress,
    Snapshots,
    SolveProgress,
    SolverOptions,
    run_key,
    solve_snapshots,
    solver_key,
)
from .console import notice


@dataclass(frozen=True)
class GivenSamples:
    """Samples that are known beforehand.

    parameters : (k, p)
    """

    parameters: NDArray[np.float64]

    @property
    def count(self) -> int:
        """How many there are at most."""
        return len(self.parameters)

    def key(self, problem: PosingProblem | InterpolationProblem, options: SolverOptions) -> str:
        """Hash of what their solutions depend on."""
        return run_key(problem, self.parameters, solver_key(options, problem))

    def finished(self, checkpoint: Checkpoint) -> int:
        """How many are saved."""
        return len(checkpoint.numbers())

    def solve(
        self,
        problem: PosingProblem | InterpolationProblem,
        options: SolverOptions,
        *,
        threads: int | None,
        progress: Progress,
        checkpoint: Checkpoint,
        executor: Executor | None,
    ) -> Snapshots:
        """As `solve_snapshots`."""
        return solve_snapshots(
            problem,
            self.parameters,
            options=options,
            threads=threads,
            progress=progress,
            checkpoint=checkpoint,
            executor=executor,
        )


@dataclass(frozen=True, kw_only=True)
class ChosenSamples:
    """Samples in batches, until the target is reached; as for `greedy_snapshots`."""

    count: int
    seed: int
    candidates: int
    dimension: int
    target: float | None

    def key(self, problem: PosingProblem | InterpolationProblem, options: SolverOptions) -> str:
        """Hash of what the choice and its solutions depend on."""
        return greedy_key(problem, options, seed=self.seed, batch=BATCH, candidates=self.candidates)

    def finished(self, checkpoint: Checkpoint) -> int:
        """How many are saved."""
        return finished_samples(checkpoint)

    def solve(
        self,
        problem: PosingProblem | InterpolationProblem,
        options: SolverOptions,
        *,
        threads: int | None,
        progress: Progress,
        checkpoint: Checkpoint,
        executor: Executor | None,
    ) -> Snapshots:
        """As `greedy_snapshots`, with a line that says whether the target was reached."""
        error: float | None = None

        def told(state: SolveProgress) -> None:
            nonlocal error
            error = state.held_out_error
            progress(state)

        snapshots = greedy_snapshots(
            problem,
            self.count,
            target=self.target,
            dimension=self.dimension,
            candidates=self.candidates,
            seed=self.seed,
            options=options,
            threads=threads,
            progress=told,
            checkpoint=checkpoint,
            executor=executor,
        )
        if self.target is not None:
            notice(_outcome(self.target, error, len(snapshots)))
        return snapshots


Samples = GivenSamples | ChosenSamples


def _outcome(target: float, error: float | None, samples: int) -> str:
    if error is None:
        return f"notice: {samples} samples are one batch, so there are none to test the target with"
    last = f"the last samples are within {100 * error:.2g} % of the subspace of those before"
    if error < target:
        return f"{samples} samples reach the target: {last}"
    return (
        f"notice: {samples} samples do not reach the target of {100 * target:.2g} %: {last}; raise "
        "--samples or --dimension"
    )


def sampling_record(
    samples: Samples, method: str, *, asked: int, seed: int, scramble: bool
) -> dict[str, Any]:
    """How the samples were chosen, for the record in the model."""
    record: dict[str, Any] = {
        "method": method,
        "samples": asked,
        "seed": seed,
        "scramble": scramble,
    }
    if isinstance(samples, ChosenSamples):
        record |= {
            "batch": BATCH,
            "candidates": samples.candidates,
            "target_error": samples.target,
        }
    return record
