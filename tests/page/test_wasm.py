"""The WebAssembly module in the repository is that of the present sources, by its record.

`make wasm` builds it again and compares.
"""

from __future__ import annotations

import hashlib
import json

from .tools import tool

build_wasm = tool("build_wasm")
RUN = "run: pip install ziglang; python tools/build_wasm.py"


def test_the_module_is_of_the_present_sources() -> None:
    record = json.loads(build_wasm.RECORD.read_text(encoding="utf-8"))
    module = build_wasm.MODULE.read_bytes()
    assert record["sources_sha256"] == build_wasm.sources_hash(), f"core/online changed; {RUN}"
    assert record["module_sha256"] == hashlib.sha256(module).hexdigest(), f"altered by hand; {RUN}"
    assert module[:4] == b"\0asm" and len(module) < 200_000
