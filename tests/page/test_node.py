"""Where the page's build finds Node.js: the package of PyPI, else a system's that is new enough."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from .tools import tool

node = tool("node")


@pytest.fixture
def without_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(node, "PACKAGE", "no_such_package")


def system_node(folder: Path, version: str) -> Path:
    """A folder for the path, with a `node` of this version and its npm, as conda installs them."""
    programs, npm = folder / "bin", folder / "lib" / "node_modules" / "npm" / "bin"
    programs.mkdir()
    npm.mkdir(parents=True)
    (npm / "npm-cli.js").touch()
    program = programs / "node"
    program.write_text(f"#!/bin/sh\necho {version}\n")
    program.chmod(0o755)
    return programs


@pytest.mark.skipif(os.name == "nt", reason="the fake program is a shell script")
@pytest.mark.parametrize(("version", "new_enough"), [("v22.4.1", True), ("v20.19.0", False)])
def test_a_new_enough_node_of_the_system_serves_without_the_package(
    without_package: None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    version: str,
    new_enough: bool,
) -> None:
    monkeypatch.setenv("PATH", str(system_node(tmp_path, version)))
    if new_enough:
        assert node.node() == (tmp_path / "bin" / "node").resolve()
        assert node.npm().parts[-2:] == ("bin", "npm-cli.js")
    else:
        assert node.node() is None and node.npm() is None


def test_without_package_and_system_there_is_no_node(
    without_package: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert node.node() is None and node.npm() is None
