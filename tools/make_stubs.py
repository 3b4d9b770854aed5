"""Writes snapspace/_core.pyi, the types of the compiled core, from the installed module.

Run this after a change of core/bindings; a test compares the file with the output of this script.
"""

from __future__ import annotations

import re
from pathlib import Path

from nanobind.stubgen import StubGen

from snapspace import _core

PATH = Path(__file__).parent.parent / "snapspace" / "_core.pyi"

OWN_NAMES = """
BUILDS: dict[str, int]
level: str

def available_levels() -> list[str]: ...
"""


def stub_text() -> str:
    """The stub of the compiled module, with the names that _core.py adds."""
    generator = StubGen(_core.core)
    generator.put(_core.core)
    text: str = generator.get()
    # layouts are checked at each call; in the stub they would only make types hard to read
    text = re.sub(r"Annotated\[(NDArray\[[\w.]+\]), dict\(.*?\)\]", r"\1", text)
    text = text.replace("from typing import Annotated\n", "")
    # the number of lanes differs from build to build
    text = re.sub(r"lane_count: int = \d+", "lane_count: int", text)
    return text.replace(_core.core.__name__, "snapspace._core").rstrip() + "\n" + OWN_NAMES


if __name__ == "__main__":
    PATH.write_text(stub_text())
    print(f"wrote {PATH}")
