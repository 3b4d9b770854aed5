"""Progress over batches is reported like that of a single run."""

from __future__ import annotations

import pytest

from snapspace import SolveProgress
from snapspace.greedy.batch_progress import BatchProgress


def test_samples_of_finished_batches_are_counted() -> None:
    seen: list[SolveProgress] = []
    progress = BatchProgress(seen.append, 30)
    for done, solved in ((4, 0), (10, 6)):  # four were in the checkpoint
        progress(SolveProgress(done, 10, 1.0, solved, 0.9))
    progress.finish_batch(None)
    progress(SolveProgress(3, 10, 0.5, 3, 0.9))
    progress.finish_batch(0.25)
    progress(SolveProgress(0, 10, 0.1, 0))
    assert [(state.done, state.solved) for state in seen] == [
        (4, 0),
        (10, 6),
        (10, 6),
        (13, 9),
        (13, 9),
        (13, 9),
    ]
    assert all(state.total == 30 for state in seen)
    # errors reported within a batch concern that batch alone and are not passed on
    assert [state.held_out_error for state in seen] == [None, None, None, None, 0.25, 0.25]


def test_the_time_is_that_of_all_batches() -> None:
    seen: list[SolveProgress] = []
    progress = BatchProgress(seen.append, 4)
    progress.begin -= 100.0
    progress(SolveProgress(2, 4, 1.0, 2))
    assert seen[0].seconds >= 100.0
    assert seen[0].eta == pytest.approx(seen[0].seconds)
