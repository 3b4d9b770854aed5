"""Finished samples move from memory to disk, or stay in memory if the disk is full."""

from __future__ import annotations

import gc
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    Checkpoint,
    Interrupted,
    SampleReport,
    Snapshots,
    SolverOptions,
    solve_snapshots,
)
from snapspace.snapshots import CheckpointNotice, UnsavedSamplesError

from .bars import assert_same_bits, parameters, posing_bar
from .scripted_backend import Script

FloatArray = NDArray[np.float64]

COUNT, BLOCK = 22, 4
PROBLEM = posing_bar(6, 2, 2)
SAMPLES = parameters(PROBLEM, COUNT)


class FullDisk(Checkpoint):
    """A checkpoint that fails to save a number of times."""

    def __init__(self, folder: Path, *, failures: int) -> None:
        super().__init__(folder)
        self.left = failures
        self.attempts = 0

    def save(
        self,
        indices: Sequence[int],
        displacements: Iterable[FloatArray],
        reports: Sequence[SampleReport],
        *,
        run: str = "",
    ) -> list[FloatArray]:
        self.attempts += 1
        if self.left:
            self.left -= 1
            message = f"{self.folder}: {len(indices)} finished samples are not saved: no room"
            raise UnsavedSamplesError(message, indices, list(displacements), reports)
        return super().save(indices, displacements, reports, run=run)


@pytest.fixture(scope="module")
def whole() -> Snapshots:
    return solved(None)


def solved(checkpoint: Checkpoint | None) -> Snapshots:
    return solve_snapshots(
        PROBLEM, SAMPLES, options=SolverOptions(block=BLOCK), threads=1, checkpoint=checkpoint
    )


def test_samples_that_cannot_be_saved_are_saved_later(whole: Snapshots, tmp_path: Path) -> None:
    checkpoint = FullDisk(tmp_path / "run", failures=2)
    with (
        Script().plays(),
        pytest.warns(CheckpointNotice, match=r"are not saved: no room") as notices,
    ):
        found = solved(checkpoint)
    assert len(notices) == 2
    assert_same_bits(found, whole)
    saved = checkpoint.load()
    assert sorted(saved) == list(range(COUNT))
    for index, (displacement, _) in saved.items():
        np.testing.assert_array_equal(displacement, whole.displacements[index])


def test_a_disk_that_stays_full_costs_only_the_checkpoint(whole: Snapshots, tmp_path: Path) -> None:
    checkpoint = FullDisk(tmp_path / "run", failures=1000)
    with Script().plays(), pytest.warns(CheckpointNotice):
        found = solved(checkpoint)
    assert_same_bits(found, whole)
    assert not checkpoint.folder.exists()


def test_a_full_disk_is_tried_again_block_by_block(tmp_path: Path) -> None:
    """Each attempt writes all unsaved samples and gives a notice, so samples do not try alone."""
    checkpoint = FullDisk(tmp_path / "run", failures=1000)
    with Script().plays(), pytest.warns(CheckpointNotice) as notices:
        solved(checkpoint)
    assert checkpoint.attempts == len(notices) <= -(-COUNT // BLOCK) + 1


def test_ctrl_c_on_a_full_disk_is_still_ctrl_c(whole: Snapshots, tmp_path: Path) -> None:
    def ctrl_c(given: int) -> None:
        if given == 10:
            raise KeyboardInterrupt

    checkpoint = FullDisk(tmp_path / "run", failures=1000)
    with Script(before_wait=ctrl_c).plays(), pytest.warns(CheckpointNotice):
        with pytest.raises(Interrupted, match=r"^10 of 22 samples are finished$"):
            solved(checkpoint)
    assert_same_bits(solved(Checkpoint(tmp_path / "run")), whole)


@pytest.mark.parametrize("seed", range(3))
def test_saved_samples_leave_the_memory(whole: Snapshots, tmp_path: Path, seed: int) -> None:
    """They may exceed the memory; later accesses map them from the files."""
    script = Script(seed)
    with script.plays():
        found = solved(Checkpoint(tmp_path / "run"))
    gc.collect()
    in_memory = [
        i for i, array in zip(script.given, script.arrays, strict=True) if array() is not None
    ]
    assert in_memory == []
    assert_same_bits(found, whole)


def test_without_a_checkpoint_samples_are_kept_once(whole: Snapshots) -> None:
    script = Script()
    with script.plays():
        found = solved(None)
    arrays = [array() for array in script.arrays]
    for index, array in zip(script.given, arrays, strict=True):
        assert array is not None
        assert np.shares_memory(array, found.displacements[index])
