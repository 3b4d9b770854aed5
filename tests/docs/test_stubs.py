"""The typed stub of the compiled core is up to date with its bindings."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent


def test_stub_is_up_to_date() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_stubs.py"))
    written = (ROOT / "snapspace" / "_core.pyi").read_text(encoding="utf-8")
    assert tool["stub_text"]() == written, "run python tools/make_stubs.py"
