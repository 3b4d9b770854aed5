"""Checks a wheel as a user installs it: with only Python and PyPI, no compiler, no Node.js.

python tools/check_wheel.py dist/snapspace-*.whl
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import venv
import zipfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
LEVELS = ROOT / "tests" / "snapshots" / "test_levels.py"
#: Compilers fuse different products at each level, so every level is tested.
WIDTHS = Path("tests") / "snapshots" / "test_pack_widths.py"
X86_LEVELS = ("_core_baseline", "_core_v3", "_core_v4")
DEMO = ["snapspace", "demo", "--output", "demo", "--tets", "5000", "--samples", "24"]


def check(wheel: Path) -> None:
    """SystemExit with the fault, if there is one."""
    _check_content(wheel)
    with tempfile.TemporaryDirectory() as name:
        clean = _Clean(Path(name))
        clean.run("pip", "install", "--quiet", str(wheel))
        clean.run("snapspace", "--version")
        clean.run(*DEMO, "--dimension", "12")
        clean.expect(
            {"creature.snapspace", "creature.html", "creature.obj"}, without="creature.png"
        )
        _expect_refusal(clean.run("snapspace", "view", code=2), "snapspace[view]")
        picture = ["pose", "demo/creature.snapspace", "--png", "a.png"]
        _expect_refusal(clean.run("snapspace", *picture, code=2), "snapspace[pictures]")
        clean.run(
            "pip", "install", "--quiet", f"snapspace[all] @ {wheel.resolve().as_uri()}", "pytest"
        )
        clean.run(*DEMO, "--dimension", "12")
        clean.expect({"creature.png"})
        shutil.copy2(LEVELS, clean.folder)
        test = ("pytest", "-q", "-W", "error", "-p", "no:cacheprovider")
        clean.run(*test, LEVELS.name)
        shutil.copytree(ROOT / "tests", clean.folder / "tests")
        listed = "from snapspace import _core; print(*_core.available_levels())"
        for level in clean.run("python", "-c", listed).split():
            clean.run(*test, "--noconftest", str(WIDTHS), level=level)
    print(f"{wheel.name}: no fault found")


class _Clean:
    """A new environment in a new folder, which finds no programs except its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        venv.create(folder / "venv", with_pip=True)
        self.programs = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        for name in ("cc", "c++", "g++", "clang++", "cmake", "node", "npm"):
            if shutil.which(name, path=str(self.programs)):
                raise SystemExit(f"check_wheel: {name} is in the environment")

    def run(self, program: str, *words: str, code: int = 0, level: str | None = None) -> str:
        """The output of a program, at a level; SystemExit unless it ends with the code."""
        kept = {k: v for k, v in os.environ.items() if k.startswith(("PIP_", "SSL_", "SYSTEMROOT"))}
        finished = subprocess.run(
            [str(self.programs / program), *words],
            cwd=self.folder,
            env=kept
            | {"PATH": str(self.programs), "HOME": str(self.folder)}
            | ({} if level is None else {"SNAPSPACE_LEVEL": level}),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        if finished.returncode != code:
            print(finished.stdout)
            raise SystemExit(
                f"check_wheel: {program} {' '.join(words)} ended with {finished.returncode}"
            )
        return finished.stdout

    def expect(self, names: set[str], *, without: str | None = None) -> None:
        """SystemExit unless the demo has written files of these names."""
        found = {path.name for path in (self.folder / "demo").iterdir()}
        if not names <= found or without in found:
            raise SystemExit(f"check_wheel: the demo wrote {sorted(found)}")


def _expect_refusal(output: str, extra: str) -> None:
    if output.count("\n") != 1 or f'pip install "{extra}"' not in output:
        raise SystemExit(f"check_wheel: expected one line that names {extra}, got:\n{output}")


def _check_content(wheel: Path) -> None:
    """SystemExit unless the wheel has the page, the types, and on x86-64 Linux every level."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    wanted = ["snapspace/page/page.html", "snapspace/py.typed", "snapspace/__init__.pyi"]
    if "linux" in wheel.name and "x86_64" in wheel.name:
        wanted += [f"snapspace/{level}." for level in X86_LEVELS]
    for start in wanted:
        if not any(name.startswith(start) for name in names):
            raise SystemExit(f"check_wheel: {wheel.name} has no {start}")


if __name__ == "__main__":
    check(Path(sys.argv[1]))
