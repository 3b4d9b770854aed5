"""Checks the Blender extension in Blender itself, which PyPI has as the module bpy.

It runs tests/blender, then installs the zip file of `make blender` in an empty Blender and poses a
bar (tools/try_extension.py). bpy 5.0 needs Python 3.11; with another Python, the script says so and
checks nothing.

    python tools/check_blender.py
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from build_blender import BUILD, PYTHON, build, this_platform
from project import ROOT

#: Blender itself, and the numpy that its own Python has.
BPY, NUMPY = "bpy==5.0.1", "numpy==1.26.4"
#: A Python without the packages of the project.
BLENDER_PYTHON = Path(sys.base_prefix) / "bin" / f"python{PYTHON}"


def installed(requirement: str) -> Path:
    """The folder with one package from PyPI, without its dependencies."""
    folder = BUILD / requirement
    if not folder.exists():
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target"]
        with tempfile.TemporaryDirectory(dir=BUILD) as name:
            subprocess.run([*pip, name, requirement], check=True)
            Path(name).rename(folder)
            Path(name).mkdir()
    return folder


def run(command: list[str], paths: list[Path], **environment: str) -> None:
    """Runs a command that finds the packages in these folders."""
    path = os.pathsep.join(map(str, paths))
    subprocess.run(
        command, check=True, cwd=ROOT, env={**os.environ, "PYTHONPATH": path, **environment}
    )


def main() -> None:
    """Runs both checks."""
    running = f"{sys.version_info.major}.{sys.version_info.minor}"
    if running != PYTHON:
        print(f"check_blender: bpy is for Python {PYTHON}, and this is {running}: nothing checked")
        return
    BUILD.mkdir(parents=True, exist_ok=True)
    bpy, numpy = installed(BPY), installed(NUMPY)
    tests = [sys.executable, "-m", "pytest", "-q", "tests/blender"]
    run(tests, [bpy], SNAPSPACE_NEEDS_BLENDER="1")
    archive = build(this_platform())
    with tempfile.TemporaryDirectory() as resources:
        command = [str(BLENDER_PYTHON), "-s", "tools/try_extension.py", str(archive)]
        run(command, [bpy, numpy], BLENDER_USER_RESOURCES=resources)


if __name__ == "__main__":
    main()
