"""The program itself: help, version, `python -m`, internal faults, closed pipes."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

import snapspace

from .conftest import Run, interrupted_as

COMMANDS = ("demo", "build", "validate", "pose", "info")

ABANDONS_WORK = """
import sys
import time
from snapspace.cli import program
from snapspace.interruptible import begin_abandonable
from tests.snapshots.bars import posing_bar

class Lasting:
    def __del__(self, sleep=time.sleep):
        sleep(2.0)

def validate(*words):
    problem = posing_bar(40, 12, 12)
    begin_abandonable(lambda: problem.system)
    time.sleep(0.02)
    raise KeyboardInterrupt

lasting = Lasting()
sys.modules["snapspace.cli.main"].snapspace.make_context = validate
program()
"""


def test_version(run: Run) -> None:
    result = run("--version")
    assert (result.code, result.out) == (0, f"snapspace {snapspace.__version__}\n")


@pytest.mark.parametrize("flag", ["-h", "--help"])
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_an_example(run: Run, command: str, flag: str) -> None:
    result = run(command, flag)
    assert result.code == 0
    assert f"    snapspace {command}" in result.out
    assert "--json" in result.out


def test_without_a_command_the_help_is_shown(run: Run) -> None:
    result = run()
    assert result.code == 0
    for command in COMMANDS:
        assert f"  {command}" in result.out


def test_as_a_module(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "snapspace", "info", str(tmp_path / "none.mesh")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (f"snapspace: error: {tmp_path / 'none.mesh'}: there is no such file\n")


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch) -> None:
    """An internal fault in every command that loads a model."""

    def fault(*_: object) -> None:
        raise ZeroDivisionError("a fault\nof two lines")

    monkeypatch.setattr("snapspace.cli.loading.load", fault)


@pytest.mark.usefixtures("broken")
def test_an_internal_fault_is_one_line_and_its_traceback_is_in_a_file(
    run: Run, model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    result = run("pose", model)
    (log,) = tmp_path.glob("snapspace-fault-*.log")
    assert (result.code, result.out) == (1, "")
    assert result.err == (
        "snapspace: error: this is a bug in snapspace, not a mistake in your input "
        f"(ZeroDivisionError: a fault of two lines); its traceback is in {log}; "
        "please report it with that file\n"
    )
    report = log.read_text()
    assert "Traceback (most recent call last)" in report and "in fault" in report
    assert f"snapspace pose {model}" in report


@pytest.mark.usefixtures("broken")
def test_a_traceback_that_cannot_be_written_is_shown(
    run: Run, model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "none"))
    result = run("pose", model)
    assert result.code == 1
    assert "ZeroDivisionError: a fault" in result.err
    assert "its traceback is above" in result.err.splitlines()[-1]


def test_too_little_memory_is_one_line(
    run: Run, model: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def greedy(*_: object) -> None:
        raise MemoryError("8 TB")

    monkeypatch.setattr("snapspace.cli.loading.load", greedy)
    assert "not enough memory (8 TB)" in run("pose", model).error


def test_an_interrupt_anywhere_is_exit_code_130(
    run: Run, model: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("snapspace.cli.loading.load", interrupted)
    result = run("validate", model)
    assert (result.code, result.out, result.err) == (130, "", "snapspace: interrupted\n")


def test_ctrl_c_is_not_a_mistake_of_the_user(
    run: Run, model: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """This holds even where a library turns it into its own error."""
    broken = interrupted_as(ValueError("cannot compare these types"))
    monkeypatch.setattr("snapspace.cli.loading.load", broken)
    result = run("validate", model)
    assert (result.code, result.out, result.err) == (130, "", "snapspace: interrupted\n")


def test_abandoned_work_does_not_end_the_program_by_a_signal() -> None:
    """The work returns while Python shuts down, which `Lasting` delays."""
    result = subprocess.run(
        [sys.executable, "-c", ABANDONS_WORK], capture_output=True, text=True, timeout=60
    )
    assert (result.returncode, result.stderr) == (130, "snapspace: interrupted\n")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such pipes")
def test_a_reader_that_closes_the_pipe_is_not_an_error(model: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "snapspace", "info", str(model), "--json"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None and process.stderr is not None
    process.stdout.close()
    err = process.stderr.read()
    assert process.wait(timeout=60) == 141
    process.stderr.close()
    assert "Traceback" not in err
    assert "Broken" not in err
