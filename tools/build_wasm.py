"""Builds web/generated/core.wasm, the live solve for browsers, from core/online.

The compiler is clang from PyPI's `ziglang` package, in the exact version below, so that the same
sources give the same bytes everywhere. The module is checked in. core.json beside it records the
hash of its sources, which a test compares with the current sources. Run this after a change of
core/online, or of files that it includes:

    pip install ziglang==0.17.1
    python tools/build_wasm.py

`--check` builds it and compares: the module that is checked in must have the same bytes.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import core_header

ROOT = Path(__file__).parent.parent
MODULE = ROOT / "web" / "generated" / "core.wasm"
RECORD = ROOT / "web" / "generated" / "core.json"
UNIT = ROOT / "web" / "engine" / "module.cpp"

ZIGLANG = "0.17.1"
EXPORTS = ("malloc", "free", *(function.name for function in core_header.functions()))
FLAGS = (
    "-target",
    "wasm32-wasi",
    "-mcpu=generic+simd128+bulk_memory+nontrapping_fptoint+sign_ext",
    "-mexec-model=reactor",
    "-std=c++20",
    "-O3",
    "-fno-exceptions",
    "-fno-rtti",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-s",
    "-Wl,--no-entry",
    *(f"-Wl,--export={name}" for name in EXPORTS),
)


def sources() -> list[Path]:
    """All files from which the module is built: the unit, and the files that it includes."""
    found = {UNIT}
    waiting = [UNIT]
    while waiting:
        text = waiting.pop().read_text(encoding="utf-8")
        included = {
            ROOT / "core" / name for name in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE)
        }
        waiting += included - found
        found |= included
    return sorted(found)


def sources_hash() -> str:
    """SHA-256 of names and contents of the sources, of the flags and of the compiler's version."""
    digest = hashlib.sha256("\n".join([ZIGLANG, *FLAGS]).encode())
    for path in sources():
        content = path.read_bytes().replace(b"\r\n", b"\n")
        name = path.relative_to(ROOT).as_posix()
        digest.update(f"\n{name} {len(content)}\n".encode() + content)
    return digest.hexdigest()


def build() -> bytes:
    """The compiled module; CalledProcessError if the compiler rejects the sources."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "core.wasm"
        command = [sys.executable, "-m", "ziglang", "c++", *FLAGS, "-I", "core"]
        # relative paths give the same bytes in any folder
        source = UNIT.relative_to(ROOT).as_posix()
        subprocess.run([*command, source, "-o", str(target)], check=True, cwd=ROOT)
        return target.read_bytes()


def has_compiler() -> bool:
    """Whether ziglang is installed in the required version."""
    if importlib.util.find_spec("ziglang") is None:
        return False
    from importlib.metadata import version

    return version("ziglang") == ZIGLANG


def main() -> int:
    """Builds the module and writes it with its record, or compares it with the one there is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--check", action="store_true", help="compare and write nothing")
    options = parser.parse_args()
    if not has_compiler():
        print(f"build_wasm: needs ziglang {ZIGLANG}: pip install ziglang=={ZIGLANG}")
        return 2
    module = build()
    if options.check:
        same = module == MODULE.read_bytes()
        place, verdict = MODULE.relative_to(ROOT), "has the same bytes" if same else "differs"
        print(f"build_wasm: {place} {verdict}" + ("" if same else f"; run {Path(__file__).name}"))
        return 0 if same else 1
    record = {
        "compiler": f"ziglang {ZIGLANG}",
        "flags": list(FLAGS),
        "sources_sha256": sources_hash(),
        "module_sha256": hashlib.sha256(module).hexdigest(),
        "bytes": len(module),
    }
    MODULE.parent.mkdir(exist_ok=True)
    MODULE.write_bytes(module)
    RECORD.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(f"wrote {MODULE.relative_to(ROOT)}, {len(module)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
