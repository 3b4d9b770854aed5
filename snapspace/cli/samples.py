"""The samples of a build: given beforehand, or chosen during the build."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..greedy import BATCH, CANDIDATES, finished_samples, greedy_key, greedy_snapshots
from ..problem import InterpolationProblem, PosingProblem
from ..snapshots import (
    Checkpoint,
    Progress,
    Snapshots,
    SolverOptions,
    run_key,
    solve_snapshots,
    solver_key,
)


@dataclass(frozen=True)
class GivenSamples:
    """Samples whose parameters (k, p) are given beforehand."""

    parameters: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of samples."""
        return len(self.parameters)

    def key(self, problem: PosingProblem | InterpolationProblem, options: SolverOptions) -> str:
        """Hash of everything that their solutions depend on."""
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
    """Samples in batches, where the current model is worst; see `greedy_snapshots`."""

    count: int
    seed: int
    dimension: int

    def key(self, problem: PosingProblem | InterpolationProblem, options: SolverOptions) -> str:
        """Hash of everything that the choice and its solutions depend on."""
        return greedy_key(problem, options, seed=self.seed, batch=BATCH, candidates=CANDIDATES)

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
        """As `greedy_snapshots`."""
        return greedy_snapshots(
            problem,
            self.count,
            dimension=self.dimension,
            seed=self.seed,
            options=options,
            threads=threads,
            progress=progress,
            checkpoint=checkpoint,
            executor=executor,
        )


Samples = GivenSamples | ChosenSamples


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
        record |= {"batch": BATCH, "candidates": CANDIDATES}
    return record
