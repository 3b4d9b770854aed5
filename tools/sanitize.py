"""Builds the core with ASan and UBSan (build/sanitize) and runs the tests of the core with it.

    python tools/sanitize.py                    # the widest level that this processor can run
    python tools/sanitize.py --level baseline   # another level
    python tools/sanitize.py tests/online -x    # other tests, with options of pytest
    python tools/sanitize.py --fuzz 60          # mutated model files, for 60 s

A fault ends the tests with the sanitizer's report. It needs GCC and the environment of
`make setup`.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from snapspace import _core

ROOT = Path(__file__).parent.parent
BUILD = ROOT / "build" / "sanitize"
SUPPRESSIONS = Path(__file__).parent / "sanitizer_suppressions"

#: Packages with tests that run C++ code. Tests of other processes, pages and servers are left out,
#: since the sanitizers work in this process only.
TESTS = (
    "certificate", "cholesky", "cubature", "displacements", "energy", "fitting", "greedy",
    "material", "multigrid", "online", "reduction", "session", "shells", "snapshots", "subspace",
)  # fmt: skip
#: These measure times, start processes, or compare with builds that do not exist here.
LEFT_OUT = (
    "tests/snapshots/test_dask.py",
    "tests/snapshots/test_levels.py",
    "tests/online/test_c_entry.py",
    "tests/online/test_c_example.py",
    "tests/reduction/test_claims.py::test_the_cost_is_within_an_order_of_magnitude",
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--level", choices=_core.BUILDS, default=_core.level)
    parser.add_argument("--fuzz", type=float, metavar="SECONDS", help="run the fuzzers instead")
    options, pytest_options = parser.parse_known_args()
    compiler = build(options.level)
    folder, python = environment(options.level)
    variables = runtime(compiler, options.level)
    if options.fuzz:
        command = [python, "-m", "fuzz", "load", "load_snapshots", "--seconds", str(options.fuzz)]
        return subprocess.call(command, cwd=folder, env=variables)
    chosen = [option for option in pytest_options if option.startswith("tests")]
    tests = [] if chosen else [f"tests/{name}" for name in TESTS]
    ignored = [f"--deselect={path}" for path in LEFT_OUT]
    command = [python, "-m", "pytest", *ignored, *tests, *pytest_options]
    return subprocess.call(command, cwd=folder, env=variables)


def build(level: str) -> str:
    """Builds the modules of one level; returns the compiler."""
    configure = [
        "cmake", "-S", str(ROOT), "-B", str(BUILD / "core"), "-G", "Ninja",
        "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DSNAPSPACE_SANITIZE=ON",
        f"-DPython_EXECUTABLE={sys.executable}",
    ]  # fmt: skip
    scripts = sysconfig.get_path("scripts")
    path = {**os.environ, "PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}"}
    subprocess.run(configure, check=True, env=path, stdout=subprocess.DEVNULL)
    targets = ["_cpu_level", f"_core_{level}"]
    command = ["cmake", "--build", str(BUILD / "core"), "--target", *targets]
    subprocess.run(command, check=True, env=path)
    cache = (BUILD / "core" / "CMakeCache.txt").read_text(encoding="utf-8")
    key = "CMAKE_CXX_COMPILER:"
    return next(line for line in cache.splitlines() if line.startswith(key)).partition("=")[2]


def environment(level: str) -> tuple[Path, str]:
    """A copy of this folder by links, with the sanitized modules, and a Python to run there."""
    folder = BUILD / level
    shutil.rmtree(folder, ignore_errors=True)  # does not follow links
    package = folder / "snapspace"
    package.mkdir(parents=True)
    left_out = {"snapspace", "build", ".venv", ".git", "__pycache__"}
    for file in ROOT.iterdir():
        if file.name not in left_out:
            (folder / file.name).symlink_to(file)
    built = [*BUILD.glob("core/_cpu_level.*.so"), *BUILD.glob(f"core/_core_{level}.*.so")]
    for file in [*(ROOT / "snapspace").iterdir(), *built]:
        if file.name != "__pycache__":
            (package / file.name).symlink_to(file)
    venv = BUILD / "venv"
    python = venv / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(venv)], check=True)
    # Paths in such a file are searched, but .pth files in them are not read. So the one of the
    # editable installation, which would find the usual modules first, has no effect.
    paths = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    found = next(venv.glob("lib/python*/site-packages"))
    (found / "sanitize.pth").write_text("\n".join(paths) + "\n", encoding="utf-8")
    return folder, str(python)


def runtime(compiler: str, level: str) -> dict[str, str]:
    """The environment of a process that runs the sanitized modules."""
    libraries = []
    # Python is not linked with the runtime, which must be loaded first. When it starts, the runtime
    # looks for the library that throws exceptions, which Python has not loaded yet.
    for name in ("libasan.so", "libstdc++.so.6"):
        command = [compiler, f"-print-file-name={name}"]
        found = subprocess.check_output(command, text=True).strip()
        if not Path(found).is_absolute():
            raise SystemExit(f"sanitize: {compiler} has no {name}; set CXX to a GCC that has it")
        libraries.append(str(Path(found).resolve()))
    return {
        **os.environ,
        "LD_PRELOAD": ":".join(libraries),
        "SNAPSPACE_LEVEL": level,
        # Python keeps objects until the process ends; reports of them would hide others.
        "ASAN_OPTIONS": "detect_leaks=0:strict_string_checks=1:detect_stack_use_after_return=1",
        "UBSAN_OPTIONS": f"print_stacktrace=1:suppressions={SUPPRESSIONS}",
    }


if __name__ == "__main__":
    sys.exit(main())
