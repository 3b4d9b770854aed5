"""Ctrl-C during a build keeps the finished samples; the same command ends with the same model."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from safetensors.numpy import load_file

from snapspace import Checkpoint, write_tets
from snapspace.cli import pipeline

from .conftest import Run, interrupted_as
from .files import bar_mesh, write_problem

PATIENCE = 60.0  # seconds until the test gives up on the other process
SAMPLES = 200
# A process whose parent ignores SIGINT inherits that, for instance in the background of a shell.
PROGRAM = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from snapspace.cli import program; program()"
)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows cannot send SIGINT to one process")
def test_an_interrupted_build_resumes_to_the_same_model(run: Run, tmp_path: Path) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    write_tets(tmp_path / "bar.msh", bar_mesh(16, 4, 4))
    words = ["build", "--problem", str(problem), "--samples", str(SAMPLES), "--dimension", "10"]
    words += ["--threads", "1", "-o", str(path)]

    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, *words, "--json"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            _wait_for_the_first_samples(process, tmp_path)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=PATIENCE)
        finally:
            process.kill()
    assert process.returncode == 130, err
    assert out == ""
    assert "Traceback" not in err
    last = err.splitlines()[-1]
    kept = re.fullmatch(
        rf"snapspace: interrupted: (\d+) of {SAMPLES} samples are kept; the same command resumes "
        "from there",
        last,
    )
    assert kept, err
    assert not path.exists()

    resumed = run(*words)
    assert resumed.code == 0, resumed.err
    assert f"resuming: {kept[1]} of {SAMPLES} samples were finished before" in resumed.err
    assert not list(tmp_path.glob("*.partial-*"))

    at_once = tmp_path / "at_once.snapspace"
    assert run(*words[:-1], at_once).code == 0
    first, second = load_file(path), load_file(at_once)
    assert first.keys() == second.keys()
    for name in first:
        assert first[name].tobytes() == second[name].tobytes(), name


def _wait_for_the_first_samples(process: subprocess.Popen[str], folder: Path) -> None:
    end = time.monotonic() + PATIENCE
    while not list(folder.glob("*.partial-*/samples-*")):
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end, "the build has not finished a sample"
        time.sleep(0.005)


def test_an_interrupt_after_the_samples_keeps_them_too(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", path)
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", interrupted)
        result = run(*words)
    assert (result.code, result.out) == (130, "")
    assert result.err.splitlines()[-1].startswith("snapspace: interrupted: 12 of 12 samples are ")
    assert "resuming: 12 of 12" in run(*words).err


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGTERM to receive")
def test_sigterm_keeps_them_too_with_its_own_exit_code(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Schedulers and `kill` send it."""

    def terminated(*_: object, **__: object) -> None:
        signal.raise_signal(signal.SIGTERM)
        raise AssertionError("still running")

    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", path)
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", terminated)
        result = run(*words)
    assert (result.code, result.out) == (143, "")
    assert result.err.splitlines()[-1].startswith("snapspace: terminated: 12 of 12 samples are ")
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    assert "resuming: 12 of 12" in run(*words).err


def test_the_model_is_on_the_disk_before_its_samples_are_removed(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Otherwise a power failure right after a build could lose both."""
    made: list[str] = []
    flush, rename, remove = os.fsync, os.replace, Checkpoint.remove

    def noted(name: str, call: Callable[..., None]) -> Callable[..., None]:
        def noting(*arguments: Any) -> None:
            made.append(name)
            call(*arguments)

        return noting

    monkeypatch.setattr(os, "fsync", noted("flush", flush))
    monkeypatch.setattr(os, "replace", noted("rename", rename))
    monkeypatch.setattr(Checkpoint, "remove", noted("remove", remove))
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    run("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", path)
    assert made[-4:] == ["flush", "rename", "flush", "remove"]


def test_an_interrupt_that_a_library_turns_into_an_error_keeps_them_too(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = interrupted_as(TypeError("cannot compare these types"))
    monkeypatch.setattr(pipeline, "reduce", broken)
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    result = run("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", path)
    assert (result.code, result.out) == (130, "")
    assert result.err.splitlines()[-1].startswith("snapspace: interrupted: 12 of 12 samples are ")


def test_samples_of_other_options_are_reported_and_not_used(run: Run, tmp_path: Path) -> None:
    problem = write_problem(tmp_path)
    words = ("build", "--problem", problem, "--samples", 12, "-o", tmp_path / "m.snapspace")
    run(*words, "--dimension", 4, "--max-iterations", 2)
    (leftover,) = tmp_path.glob("*.partial-*")
    result = run(*words, "--dimension", 4)
    assert result.code == 0
    assert f"{leftover} holds samples of other options" in result.err
    assert "resuming" not in result.err
    assert leftover.is_dir()


def test_a_damaged_file_is_reported_once_and_its_samples_are_solved_again(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", path)
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", interrupted)
        run(*words)
    (file, *_) = sorted(tmp_path.glob("*.partial-*/samples-*"))
    content = bytearray(file.read_bytes())
    content[-1] ^= 1
    file.write_bytes(content)
    resumed = run(*words)
    assert resumed.code == 0
    assert resumed.err.count(f"{file.name}: not used (its content has changed); its samples") == 1
