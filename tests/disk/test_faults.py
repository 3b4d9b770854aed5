"""Whatever happens while a file is written, either the old or the new one is complete."""

from __future__ import annotations

import json
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import snapspace as ss
from snapspace.cli.fit_cache import FitCache
from snapspace.disk import read_checked, sweep, write_checked
from snapspace.pictures import save_png
from snapspace.server.saving import _write_text
from snapspace.snapshots import save_snapshots
from snapspace.snapshots.sample_file import read_samples, write_samples

if sys.platform == "win32":
    pytest.skip("these faults are made by POSIX calls", allow_module_level=True)

from .faults import CALLS, at_call, full_disk, in_a_child, io_error, killed

pytestmark = pytest.mark.filterwarnings("ignore:This process .* is multi-threaded")

MESH = ss.generators.bar(3, 1, 1)
REPORT = ss.SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, 0)
POINTS = MESH.vertices

Write = Callable[[Path, float], object]


def picture(path: Path, scale: float) -> None:
    save_png(path, np.random.default_rng(int(scale)).integers(0, 255, (9, 9, 3), np.uint8))


def cached_tets(path: Path, scale: float) -> None:
    cache = FitCache(path.parent)
    cache._save(path.stem, {"vertices": scale * POINTS}, {})


#: Every function of the package that writes small files, by extension.
WRITERS: dict[str, Write] = {
    **{
        name: lambda path, scale: ss.write_surface(path, scale * POINTS, MESH.surface)
        for name in (".obj", ".off", ".ply", ".stl")
    },
    **{
        name: lambda path, scale: ss.write_tets(path, MESH, vertices=scale * POINTS)
        for name in (".msh", ".vtk", ".vtu", ".mesh")
    },
    ".checked": lambda path, scale: write_checked(path, {"a": scale * POINTS}, {"b": "c"}),
    ".part": lambda path, scale: write_samples(path, [3], [scale * POINTS.ravel()], [REPORT]),
    ".safetensors": cached_tets,
    ".json": lambda path, scale: _write_text(path, json.dumps([scale] * 9)),
    ".png": picture,
}
each_writer = pytest.mark.parametrize("suffix", WRITERS)


class Files:
    """An old file in its own folder, and the bytes of the old and the new content."""

    def __init__(self, folder: Path, suffix: str, write: Write | None = None) -> None:
        self.write = write or WRITERS[suffix]
        self.path = folder / f"a{suffix}"
        self.write(self.path, 2.0)
        self.new = self.path.read_bytes()
        self.write(self.path, 1.0)
        self.old = self.path.read_bytes()
        assert self.new != self.old

    def write_new(self) -> None:
        self.write(self.path, 2.0)

    def check(self, *, temporaries: bool = False) -> bytes:
        """The content, after checks that it is old or new and that no other file is left."""
        if temporaries:
            sweep(self.path.parent)
        if not temporaries or sys.platform == "linux":
            assert list(self.path.parent.iterdir()) == [self.path]
        content = self.path.read_bytes()
        assert content in (self.old, self.new)
        return content


@each_writer
@settings(max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(share=st.floats(0, 1, exclude_max=True))
def test_a_full_disk_leaves_the_old_file(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, share: float
) -> None:
    files = Files(tmp_path_factory.mktemp("full"), suffix)
    with full_disk(int(share * len(files.new))), pytest.raises(ValueError) as caught:
        files.write_new()
    assert str(files.path) in str(caught.value)
    assert "\n" not in str(caught.value)
    assert files.check() == files.old


@each_writer
@pytest.mark.parametrize("call", range(len(CALLS)), ids=CALLS)
def test_a_failing_call_leaves_the_old_or_new_file(tmp_path: Path, suffix: str, call: int) -> None:
    """If only the folder cannot be flushed, the new file is complete: that is not an error."""
    files = Files(tmp_path, suffix)
    with at_call(call, io_error):
        if CALLS[call] == "flush folder":
            files.write_new()
        else:
            with pytest.raises(ValueError, match="cannot be written: Input/output error"):
                files.write_new()
    expected = files.new if CALLS[call] == "flush folder" else files.old
    assert files.check() == expected


@each_writer
def test_a_kill_at_any_call_leaves_the_old_or_the_new_file(tmp_path: Path, suffix: str) -> None:
    files = Files(tmp_path, suffix)
    left = []
    for call in range(len(CALLS)):

        def work(call: int = call) -> None:
            with at_call(call, killed):
                files.write_new()

        assert in_a_child(work) == signal.SIGKILL
        left.append(files.check(temporaries=True))
    assert left == [files.old, files.old, files.new]


@each_writer
@settings(max_examples=4, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(share=st.floats(0, 1, exclude_max=True))
def test_a_kill_in_the_middle_of_a_write_leaves_the_old_file(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, share: float
) -> None:
    files = Files(tmp_path_factory.mktemp("killed"), suffix)
    assert in_a_child(files.write_new, size=int(share * len(files.new))) == signal.SIGXFSZ
    assert files.check(temporaries=True) == files.old


def test_models_pages_and_snapshots_are_written_alike(
    tmp_path: Path, posing_model: ss.PosingModel, posing_snapshots: ss.Snapshots
) -> None:
    """One case for each large file, since they take longer to write."""
    writers: dict[str, Write] = {
        ".snapspace": lambda path, scale: posing_model.leading(int(3 * scale)).save(path),
        ".html": lambda path, scale: ss.export_html(posing_model.leading(int(3 * scale)), path),
        ".samples": lambda path, scale: save_snapshots(
            posing_snapshots.select(np.arange(60) < 4 * scale), path
        ),
    }
    for suffix, write in writers.items():
        folder = tmp_path / suffix
        folder.mkdir()
        files = Files(folder, suffix, write)
        with full_disk(len(files.new) // 2), pytest.raises(ValueError, match="cannot be written"):
            files.write_new()
        assert files.check() == files.old
        assert in_a_child(files.write_new, size=len(files.new) // 2) == signal.SIGXFSZ
        assert files.check(temporaries=True) == files.old


def test_an_unsafe_writer_fails_these_checks(tmp_path: Path) -> None:
    """Otherwise this file would prove nothing."""
    unsafe = Files(tmp_path, ".x", lambda path, scale: path.write_bytes(bytes([int(scale)] * 999)))
    in_a_child(unsafe.write_new, size=500)
    with pytest.raises(AssertionError):
        unsafe.check()


def test_files_are_read_back_as_written(tmp_path: Path) -> None:
    """The bytes above are those of complete files."""
    write_checked(tmp_path / "a", {"a": POINTS}, {"b": "c"})
    arrays, words = read_checked(tmp_path / "a")
    assert (arrays["a"] == POINTS).all() and words == {"b": "c"}
    write_samples(tmp_path / "b", [3], [POINTS.ravel()], [REPORT])
    assert (read_samples(tmp_path / "b")[3][0] == POINTS.ravel()).all()
