"""BatchProgress: reports the progress of batches as that of one run."""

from __future__ import annotations

import time

from ..snapshots import Progress, SolveProgress


class BatchProgress:
    """The `progress` callable for the run of each batch; reports on all batches together.

    Parameters
    ----------
    progress : callable(SolveProgress)
        Gets the reports.
    total : int
        Largest number of samples of all batches.

    Attributes
    ----------
    held_out_error : error of the last finished batch by the batches before it; the run of a batch
        does not know the other batches
    """

    def __init__(self, progress: Progress, total: int) -> None:
        self.progress = progress
        self.total = total
        self.begin = time.perf_counter()
        self.held_out_error: float | None = None
        self._done = self._solved = 0
        self._last: SolveProgress | None = None

    def __call__(self, state: SolveProgress) -> None:
        self._last = state
        self._report(self._done + state.done, self._solved + state.solved)

    def finish_batch(self, held_out_error: float | None) -> None:
        """Adds the last report of the batch's run, and reports the error known so far."""
        if self._last is not None:
            self._done += self._last.done
            self._solved += self._last.solved
        self._last = None
        self.held_out_error = held_out_error
        self._report(self._done, self._solved)

    def _report(self, done: int, solved: int) -> None:
        seconds = time.perf_counter() - self.begin
        self.progress(SolveProgress(done, self.total, seconds, solved, self.held_out_error))
