"""GrowingSamples: solved blends, of which the last are held out."""

from __future__ import annotations

from concurrent.futures import Executor

import numpy as np
from numpy.typing import NDArray

from ..displacements import SnapshotGram
from ..problem import InterpolationProblem, solutions_beyond_tau
from ..sampling import Method, sample
from ..snapshots import Checkpoint, Progress, Snapshots, SolverOptions, solve_snapshots

FloatArray = NDArray[np.float64]

#: One sample in so many is held out, and these at least.
HELD_OUT_PERIOD, FEWEST_HELD_OUT = 10, 8


class GrowingSamples:
    """Samples of one sequence, solved as far as is asked.

    Parameters
    ----------
    problem : InterpolationProblem
    most : int
        Length of the sequence: `blends`, of two poses Sobol points.
    seed : int
    """

    def __init__(self, problem: InterpolationProblem, most: int, *, seed: int) -> None:
        # of two poses `blends` has the middle only once, and uniform points between
        method: Method = "blends" if problem.parameter_count > 2 else "sobol"
        self.problem = problem
        self.parameters = sample(problem.domain, most, method=method, seed=seed)
        self._snapshots: Snapshots | None = None
        self._gram = SnapshotGram.of(problem)

    @property
    def snapshots(self) -> Snapshots:
        """All that are solved; there must be some."""
        assert self._snapshots is not None
        return self._snapshots

    @property
    def trained(self) -> Snapshots:
        """The usable ones that are not held out."""
        return self.snapshots.select(self._masks()[0])

    @property
    def unseen(self) -> Snapshots:
        """The usable ones that are held out."""
        return self.snapshots.select(self._masks()[1])

    @property
    def trained_solutions(self) -> int:
        """How many solutions a basis comes from, those known without solving among them."""
        return int(self._masks()[0].sum()) + len(self._known())

    @property
    def directions(self) -> int:
        """How many directions these have."""
        return len(self.projection_errors()) - 1

    def solve_up_to(
        self,
        count: int,
        *,
        options: SolverOptions | None,
        threads: int | None,
        progress: Progress | None,
        checkpoint: Checkpoint | None,
        executor: Executor | None,
    ) -> None:
        """Solves the samples before `count` that are not; arguments as for `solve_snapshots`."""
        before = 0 if self._snapshots is None else len(self._snapshots)
        if count <= before:
            return
        stage = None if checkpoint is None else Checkpoint(checkpoint.folder / f"from-{before:05d}")
        solved = solve_snapshots(
            self.problem,
            self.parameters[before:count],
            options=options,
            threads=threads,
            progress=progress,
            checkpoint=stage,
            executor=executor,
            known=self._snapshots,
        )
        self._snapshots = solved if before == 0 else self.snapshots.joined(solved)
        self._gram.add(list(solved.displacements), threads=threads or 0)

    def projection_errors(self) -> FloatArray:
        """Of the held-out samples onto bases of the others, see `SnapshotGram.held_out_errors`."""
        gram, (trained, unseen) = self._gram.copy(), self._masks()
        gram.add(list(self._known()))
        known = np.arange(len(trained), len(gram))
        return gram.held_out_errors(
            np.append(np.flatnonzero(trained), known), np.flatnonzero(unseen)
        )

    def _known(self) -> FloatArray:
        """Displacements (k, 3n) of the solutions that are known, beside tau."""
        shapes: FloatArray = solutions_beyond_tau(self.problem)[1] - self.problem.base
        return shapes

    def _masks(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which samples (k,) train, and which are held out."""
        usable = self.snapshots.usable
        held = max(FEWEST_HELD_OUT, len(usable) // HELD_OUT_PERIOD)
        last = np.arange(len(usable)) >= len(usable) - held
        if not (usable & last).any() or not (usable & ~last).any():
            raise ValueError(
                f"accurate_blends: only {int(usable.sum())} of {len(usable)} samples converged; "
                "allow more iterations"
            )
        return usable & ~last, usable & last
