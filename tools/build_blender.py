"""Builds the Blender extension as a zip file, with wheels of all that it needs: `make blender`.

It takes the wheel of Snapspace from dist/ (`make wheels` makes one for this machine, hosted CI for
the others), and its dependencies from PyPI. Blender has numpy itself.

    python tools/build_blender.py                          # for this machine
    python tools/build_blender.py --platform windows-x64   # with a wheel for Windows in dist/
"""

from __future__ import annotations

import argparse
import platform as machine_platform
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from project import ROOT, version

SOURCE = ROOT / "blender"
BUILD = ROOT / "build" / "blender"
#: Python of Blender 4.2 to 5.0.
PYTHON = "3.11"
#: Blender 4.2 has numpy 1.24, which later versions of SciPy no longer support.
NEEDED = [
    "scipy>=1.12,<1.16",
    "safetensors>=0.4.3",
    "threadpoolctl>=3.1",
    "meshio>=5.3.5",
    "rich>=13.5",  # needed by meshio, as are the others
    "markdown-it-py>=3.0",
    "mdurl>=0.1",
    "pygments>=2.17",
]
#: Blender's names of platforms, and pip's.
PLATFORMS = {
    "linux-x64": ["manylinux_2_28_x86_64", "manylinux_2_17_x86_64", "manylinux2014_x86_64"],
    "windows-x64": ["win_amd64"],
    "macos-arm64": ["macosx_12_0_arm64", "macosx_11_0_arm64"],
    "macos-x64": ["macosx_10_14_x86_64", "macosx_10_9_x86_64"],
}


def this_platform() -> str:
    """Blender's name of this machine's platform."""
    system = {"Linux": "linux", "Windows": "windows", "Darwin": "macos"}[machine_platform.system()]
    return f"{system}-{'arm64' if machine_platform.machine() in ('arm64', 'aarch64') else 'x64'}"


def own_wheel(platform: str) -> Path:
    """The wheel of Snapspace; SystemExit without one."""
    system = {"linux": "manylinux", "windows": "win", "macos": "macosx"}[platform.split("-")[0]]
    machine = {"x64": ("x86_64", "amd64"), "arm64": ("arm64", "aarch64")}[platform.split("-")[1]]
    tag = PYTHON.replace(".", "")
    found = [
        wheel
        for wheel in sorted((ROOT / "dist").glob(f"snapspace-*-cp{tag}-cp{tag}-*.whl"))
        if wheel.stem.split("-")[-1].startswith(system) and wheel.stem.endswith(machine)
    ]
    if not found:
        raise SystemExit(
            f"build_blender: dist/ has no wheel for Python {PYTHON} on {platform}; "
            f"run `make wheels` with Python {PYTHON} first"
        )
    return found[-1]


def download(folder: Path, platform: str) -> None:
    """Wheels of the dependencies."""
    tags = [part for tag in PLATFORMS[platform] for part in ("--platform", tag)]
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", folder]
    command += ["--only-binary=:all:", "--python-version", PYTHON, *tags, *NEEDED]
    subprocess.run([*map(str, command)], check=True)


def manifest(platform: str, wheels: list[Path]) -> str:
    """The manifest with platform, wheels, and the version of the Python package."""
    text = (SOURCE / "blender_manifest.toml").read_text(encoding="utf-8")
    text = re.sub(r'^version = ".*"', f'version = "{version()}"', text, flags=re.MULTILINE)
    listed = "".join(f'  "./wheels/{wheel.name}",\n' for wheel in wheels)
    head = text[: text.index("# tools/build_blender.py")]
    return f'{head}platforms = ["{platform}"]\nwheels = [\n{listed}]\n'


def build(platform: str) -> Path:
    """Builds the zip file."""
    folder = BUILD / platform
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "wheels").mkdir(parents=True)
    shutil.copy(own_wheel(platform), folder / "wheels")
    download(folder / "wheels", platform)
    wheels = sorted((folder / "wheels").glob("*.whl"))
    for source in sorted(SOURCE.glob("*.py")):
        shutil.copy(source, folder)
    shutil.copy(ROOT / "LICENSE", folder)
    (folder / "blender_manifest.toml").write_text(manifest(platform, wheels), encoding="utf-8")
    archive = BUILD / f"snapspace-{platform}.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                file.write(path, path.relative_to(folder))
    return archive


def main() -> None:
    """Builds for the requested platform."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--platform", choices=PLATFORMS, default=this_platform())
    archive = build(parser.parse_args().platform)
    print(f"{archive.relative_to(ROOT)}, {archive.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
