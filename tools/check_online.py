"""Compiles core/online alone: without Eigen, Python or exceptions, and every header by itself.

Other builds, such as WebAssembly, use only this package. Prints the compiler's messages; the exit
code is 1 if a file does not compile.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CORE = Path(__file__).parents[1] / "core"
OPTIONS = ["-std=c++20", "-fsyntax-only", "-fno-exceptions", f"-I{CORE}", "-x", "c++", "-"]


def compiler() -> list[str]:
    """The C++ compiler that also builds snapspace."""
    wanted = os.environ.get("CXX")
    if wanted:
        return shlex.split(wanted)
    for candidate in ("c++", "g++", "clang++"):
        if shutil.which(candidate):
            return [candidate]
    sys.exit("check_online: no C++ compiler found (CXX, c++, g++, clang++)")


def units() -> list[str]:
    """Files that no other file includes first: compiling that other file covers them."""
    files = sorted([*(CORE / "online").rglob("*.h"), *(CORE / "online").rglob("*.cpp")])
    names = {path: path.relative_to(CORE).as_posix() for path in files}
    pattern = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.M)
    first = {match[1] for path in files if (match := pattern.search(path.read_text("utf-8")))}
    return [name for name in names.values() if name not in first]


def faults(unit: str, command: list[str]) -> str:
    """The compiler's messages for a file that includes only this one; empty if it compiles."""
    finished = subprocess.run(
        [*command, *OPTIONS], input=f'#include "{unit}"\n', capture_output=True, text=True
    )
    return "" if finished.returncode == 0 else f"core/{unit}:\n{finished.stderr}"


def main() -> int:
    command = compiler()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [text for text in pool.map(lambda unit: faults(unit, command), units()) if text]
    print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
