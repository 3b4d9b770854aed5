"""The project, as the other tools know it."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent


def version() -> str:
    """The version of the Python package, which all other packages share."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    found = re.search(r'^version = "([^"]+)"', text, re.MULTILINE)
    assert found is not None, "pyproject.toml has no version"
    return found[1]
