"""Disks fill up and processes die: saved samples stay, and unsaved ones are returned."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from snapspace import Checkpoint, DisplacementRows
from snapspace.snapshots import UnsavedSamplesError

from .samples import displacements, report

SIZE = 3000
#: Saves more and more samples, each filled with its own number, until it is killed.
SAVING = """
import itertools, sys
import numpy as np
from snapspace import Checkpoint, SampleReport
report = SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, 0)
checkpoint = Checkpoint(sys.argv[1])
for first in itertools.count(0, 4):
    rows = [np.full(200_000, float(i)) for i in range(first, first + 4)]
    checkpoint.save(range(first, first + 4), rows, [report] * 4)
"""


def save(checkpoint: Checkpoint, first: int, count: int) -> list[np.ndarray]:
    indices = range(first, first + count)
    rows = displacements(count, SIZE, seed=first)
    return checkpoint.save(indices, rows, [report(i) for i in indices])


@contextmanager
def largest_file(size: int) -> Iterator[None]:
    """Simulates a full disk: no file of this process may grow beyond `size` bytes."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("size", [0, 100, 50_000])
def test_a_full_disk_loses_nothing(tmp_path: Path, size: int) -> None:
    checkpoint = Checkpoint(tmp_path / "run")
    save(checkpoint, 0, 3)
    with (
        largest_file(size),
        pytest.raises(
            UnsavedSamplesError,
            match=r"run: 4 finished samples, 0\.1 MB, are not saved: cannot be written: .*; 3 "
            r"samples are kept there, and once the cause is removed the same call continues from",
        ) as caught,
    ):
        save(checkpoint, 3, 4)
    assert "\n" not in str(caught.value)
    assert len(list(checkpoint.folder.iterdir())) == 1, "no part of a file is left"
    assert sorted(checkpoint.load()) == [0, 1, 2]
    failed = caught.value
    checkpoint.save(failed.indices, failed.displacements, failed.reports)
    found = checkpoint.load()
    assert sorted(found) == list(range(7))
    rows = displacements(4, SIZE, seed=3)
    for index in range(3, 7):
        np.testing.assert_array_equal(found[index][0], rows[index - 3])
        assert found[index][1] == report(index)


def test_the_folder_is_loadable_after_a_kill(tmp_path: Path) -> None:
    """It is loadable whenever the kill comes; a notice of a damaged file would fail the test."""
    for delay in (0.0, 0.03):
        checkpoint = Checkpoint(tmp_path / str(delay))
        process = subprocess.Popen([sys.executable, "-c", SAVING, checkpoint.folder])
        end = time.monotonic() + 60.0
        while not checkpoint.numbers():
            assert process.poll() is None and time.monotonic() < end
            time.sleep(0.001)
        time.sleep(delay)
        process.kill()
        process.wait()
        found = checkpoint.load()
        assert found.keys() == checkpoint.numbers() == set(range(len(found)))
        assert all((row == index).all() for index, (row, _) in found.items())
        checkpoint.remove()
        assert not checkpoint.folder.exists()


def test_saved_rows_can_replace_the_computed_ones(tmp_path: Path) -> None:
    checkpoint = Checkpoint(tmp_path / "run")
    rows = save(checkpoint, 0, 5)
    np.testing.assert_array_equal(rows, displacements(5, SIZE, seed=0))
    assert not any(row.flags.writeable or row.flags.owndata for row in rows)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows does not delete mapped files")
def test_rows_outlive_their_folder(tmp_path: Path) -> None:
    checkpoint = Checkpoint(tmp_path / "run")
    rows = DisplacementRows(save(checkpoint, 0, 5), SIZE)
    checkpoint.remove()
    assert not checkpoint.folder.exists()
    np.testing.assert_array_equal(rows.array(), displacements(5, SIZE, seed=0))


def test_numbers_are_those_of_complete_files(tmp_path: Path) -> None:
    checkpoint = Checkpoint(tmp_path / "run")
    assert checkpoint.numbers() == set()
    save(checkpoint, 0, 3)
    save(checkpoint, 8, 2)
    assert checkpoint.numbers() == {0, 1, 2, 8, 9}
    last = sorted(checkpoint.folder.iterdir())[-1]
    last.write_bytes(last.read_bytes()[:-1])
    assert checkpoint.numbers() == {0, 1, 2}
