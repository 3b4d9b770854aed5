"""Content is on the disk before its name; temporary files of dead processes are removed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from snapspace import Checkpoint, SampleReport
from snapspace.disk import atomic_file, sweep, temporaries
from snapspace.disk.temporaries import machine_mark, temporary_name

on_linux = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nothing is swept")


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Calls that reach the system, in order: 'flush NAME' and 'rename NAME'."""
    made: list[str] = []
    names: dict[int, str] = {}
    real_open, real_sync, real_replace = os.open, os.fsync, os.replace

    def opened(path: str | Path, *rest: int) -> int:
        handle = real_open(path, *rest)
        names[handle] = Path(path).name
        return handle

    def flushed(handle: int) -> None:
        made.append(f"flush {names[handle]}")
        real_sync(handle)

    def renamed(old: Path, new: Path) -> None:
        made.append(f"rename {Path(old).name}")
        real_replace(old, new)

    monkeypatch.setattr(os, "open", opened)
    monkeypatch.setattr(os, "fsync", flushed)
    monkeypatch.setattr(os, "replace", renamed)
    return made


def test_the_content_is_flushed_before_the_rename_and_the_folder_after(
    tmp_path: Path, calls: list[str]
) -> None:
    """Otherwise a power failure could leave an empty file in place of the old one."""
    with atomic_file(tmp_path / "a.txt") as temporary:
        temporary.write_text("new")
    name = temporary.name
    assert calls == [f"flush {name}", f"rename {name}", f"flush {tmp_path.name}"]


def test_the_folder_of_a_checkpoint_is_flushed_into_its_parent(
    tmp_path: Path, calls: list[str]
) -> None:
    report = SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, 0)
    checkpoint = Checkpoint(tmp_path / "c")
    checkpoint.save([0], [np.zeros(3)], [report])
    assert calls[0] == f"flush {tmp_path.name}"
    assert calls[-1] == "flush c"


def test_a_flush_that_fails_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a network file system, blocks may be allocated only at the end: then the flush fails."""

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    (tmp_path / "a.txt").write_text("old")
    monkeypatch.setattr(os, "fsync", full)
    with (
        pytest.raises(ValueError, match=r"a\.txt: cannot be written: No space left on device"),
        atomic_file(tmp_path / "a.txt") as temporary,
    ):
        temporary.write_text("new")
    assert [path.read_text() for path in tmp_path.iterdir()] == ["old"]


def dead_process() -> int:
    """The number of a process that has just ended."""
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        return process.pid


def left_by(folder: Path, process: int, *, mark: str | None = None) -> Path:
    """A temporary file as `process` would leave it."""
    name = temporary_name(folder / "dragon.snapspace")
    name = name.replace(f"-{os.getpid()}-", f"-{process}-")
    path = folder / name.replace(machine_mark(), mark or machine_mark())
    path.write_bytes(b"half")
    return path


@on_linux
def test_files_of_a_dead_process_are_removed_and_all_others_stay(tmp_path: Path) -> None:
    stays = [
        left_by(tmp_path, os.getpid()),
        left_by(tmp_path, 1),
        left_by(tmp_path, dead_process(), mark="0" * 12),  # from another machine or container
        left_by(tmp_path, 10**9),  # no system has such a number
        tmp_path / ".dragon.snapspace",
        tmp_path / ".dragon.1234abcd.snapspace",
        tmp_path / "dragon.snapspace",
    ]
    for path in stays[4:]:
        path.write_bytes(b"of the user")
    gone = left_by(tmp_path, dead_process())
    assert sweep(tmp_path) == [gone]
    assert sorted(tmp_path.iterdir()) == sorted(stays)


@on_linux
def test_the_first_write_to_a_folder_sweeps_it(tmp_path: Path) -> None:
    gone = left_by(tmp_path, dead_process())
    with atomic_file(tmp_path / "other.txt") as temporary:
        temporary.write_text("new")
    assert not gone.exists()


def test_nothing_is_removed_where_the_boot_is_unknown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = left_by(tmp_path, dead_process())
    monkeypatch.setattr(temporaries, "_boot", lambda: None)
    assert sweep(tmp_path) == []
    assert path.exists()


def test_sweeping_a_missing_folder_does_nothing(tmp_path: Path) -> None:
    assert sweep(tmp_path / "none") == []


def test_long_names_are_written_through_shorter_temporary_names(tmp_path: Path) -> None:
    target = tmp_path / f"{'é' * 120}.txt"
    with atomic_file(target) as temporary:
        temporary.write_text("new")
    assert target.read_text() == "new"
