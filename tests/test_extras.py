"""Optional packages are loaded only where they are needed; a missing one's extra is named."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import snapspace as ss
from snapspace.cli import main
from snapspace.extras import EXTRAS, MissingExtraError, need_extra
from snapspace.pictures import Curve, chart, save_film, save_png
from snapspace.server import serve

ROOT = Path(__file__).parent.parent
TRIANGLE = np.eye(3)
OPTIONAL = [name for names in EXTRAS.values() for name in names]

WITHOUT_EXTRAS = f"""
import sys
sys.modules.update(dict.fromkeys({OPTIONAL!r}))
from importlib import import_module
import snapspace
for name in snapspace.__all__:
    getattr(snapspace, name)
from snapspace.cli.commands import COMMANDS
for name in COMMANDS:
    import_module(f"snapspace.cli.{{name}}")
import snapspace.generators, snapspace.pictures, snapspace.server
"""


def without(monkeypatch: pytest.MonkeyPatch, extra: str) -> None:
    for name in EXTRAS[extra]:
        monkeypatch.setitem(sys.modules, name, None)


def test_all_names_and_commands_load_without_any_extra() -> None:
    finished = subprocess.run(
        [sys.executable, "-c", WITHOUT_EXTRAS], capture_output=True, text=True
    )
    assert finished.returncode == 0, finished.stderr


@pytest.mark.parametrize(
    ("extra", "call", "who", "packages"),
    [
        ("fill", lambda: ss.fill_surface(*tetrahedron()), "fill_surface", "package pytetwild"),
        (
            "pictures",
            lambda: save_png("a.png", np.zeros((2, 2, 3), np.uint8)),
            "save_png",
            "package pillow",
        ),
        (
            "pictures",
            lambda: chart([Curve("a", [1.0], [1.0])], title="t", x_name="x", y_name="y"),
            "chart",
            "package pillow",
        ),
        (
            "view",
            lambda: serve(title="t"),
            "the server of the page",
            "packages starlette, uvicorn, websockets",
        ),
        (
            "video",
            lambda: save_film("a.mp4", [TRIANGLE], [[0, 1, 2]]),
            "save_film: .mp4",
            "package imageio-ffmpeg",
        ),
        ("dask", lambda: need_extra("dask", who="--dask"), "--dask", "package distributed"),
    ],
)
def test_a_call_without_its_extra_names_it(
    monkeypatch: pytest.MonkeyPatch, extra: str, call: Any, who: str, packages: str
) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    without(monkeypatch, extra)
    with pytest.raises(MissingExtraError) as caught:
        call()
    assert str(caught.value) == f'{who} needs the {packages}: pip install "snapspace[{extra}]"'
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, ImportError)


def test_intel_macs_are_not_sent_to_wheels_that_do_not_exist(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    without(monkeypatch, "fill")
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr("platform.machine", lambda: "x86_64")
    with pytest.raises(MissingExtraError, match="no wheels for Intel Macs"):
        need_extra("fill", who="fill_surface")


@pytest.mark.parametrize(
    ("extra", "words", "line"),
    [
        ("video", ["pose", "m.snapspace", "--path", "9", "-o", "a.mp4"], "-o a.mp4 needs"),
        ("view", ["view"], "snapspace view needs the packages starlette, uvicorn, websockets"),
        ("fill", ["view", "--exact"], "--exact needs the package pytetwild"),
        ("pictures", ["pose", "m.snapspace", "--png", "a.png"], "--png needs the package pillow"),
        ("pictures", ["blend", "m.snapspace", "--weights", "1,0", "--png", "a.png"], "--png needs"),
        (
            "pictures",
            ["validate", "m.snapspace", "--plot", "a.png"],
            "--plot needs the package pillow",
        ),
    ],
)
def test_a_command_without_its_extra_ends_in_one_line_before_any_work(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    extra: str,
    words: list[str],
    line: str,
) -> None:
    """The commands name a model that does not exist: that would be the next error."""
    monkeypatch.chdir(tmp_path)
    without(monkeypatch, extra)
    assert main(words) == 2
    (error,) = capsys.readouterr().err.splitlines()
    assert error.startswith(f"snapspace: error: {line}")
    assert error.endswith(f'pip install "snapspace[{extra}]"')


def test_the_extras_are_those_of_the_project() -> None:
    tomllib = pytest.importorskip("tomllib", reason="part of Python from 3.11 on")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    assert set(extras) == {*EXTRAS, "all", "docs", "lint", "test"}
    permissive = sorted(set(EXTRAS) - {"video"})  # its package contains a GPL program
    assert extras["all"] == [f"snapspace[{','.join(permissive)}]"]
    names = {re.split("[<>=]", line)[0] for line in project["dependencies"]}
    assert names == {"numpy", "scipy", "meshio", "safetensors", "click", "rich", "threadpoolctl"}


def tetrahedron() -> tuple[Any, Any]:
    return np.vstack([np.zeros(3), np.eye(3)]), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
