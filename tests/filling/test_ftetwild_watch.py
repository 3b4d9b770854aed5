"""fTetWild ends with the process that started it, and its folder is removed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from snapspace.filling import ftetwild

PATIENCE = 20.0
#: Like compiled code it ignores signals while it works; it writes its process number first.
WORK = """
import os, signal, sys, time
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
with open(os.path.join(sys.argv[1], "began.part"), "w") as file:
    file.write(str(os.getpid()))
os.rename(os.path.join(sys.argv[1], "began.part"), os.path.join(sys.argv[1], "began"))
time.sleep(600)
"""
#: A program that fills a surface, without the time to import all of snapspace.
FILLS = """
import importlib, sys, types
for name, folder in (("snapspace", ""), ("snapspace.filling", "/filling")):
    sys.modules[name] = types.ModuleType(name)
    sys.modules[name].__path__ = [sys.argv[1] + folder]
sys.modules["snapspace.interruptible"] = types.SimpleNamespace(POLL_SECONDS=0.1)
ftetwild = importlib.import_module("snapspace.filling.ftetwild")
from pathlib import Path
ftetwild._PROGRAM = Path(sys.argv[2])
ftetwild._run(Path(sys.argv[3]))
"""


def wait_for(done: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE
    while not done():
        assert time.monotonic() < end
        time.sleep(0.005)


def is_running(process: int) -> bool:
    """Whether a process still runs; a zombie does not."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


@pytest.mark.skipif(sys.platform != "linux", reason="asks Linux for the state of a process")
@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGTERM])
def test_ftetwild_dies_with_its_parent_and_its_folder_is_removed(
    tmp_path: Path, sent: signal.Signals
) -> None:
    work, folder = tmp_path / "work.py", tmp_path / "folder"
    work.write_text(WORK)
    folder.mkdir()
    package = Path(ftetwild.__file__).parents[1]
    words = [str(package), str(work), str(folder)]
    with subprocess.Popen([sys.executable, "-c", FILLS, *words]) as parent:
        try:
            wait_for((folder / "began").exists)
            process = int((folder / "began").read_text())
            assert is_running(process)
        finally:
            os.kill(parent.pid, sent)
    wait_for(lambda: not is_running(process))
    wait_for(lambda: not folder.exists())


def test_the_status_is_that_of_the_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program, folder = tmp_path / "program.py", tmp_path / "folder"
    program.write_text("import os; print(os.getcwd()); raise SystemExit(7)")
    folder.mkdir()
    monkeypatch.setattr(ftetwild, "_PROGRAM", program)
    assert ftetwild._run(folder) == (7, f"{folder.resolve()}\n")
    assert folder.is_dir()
