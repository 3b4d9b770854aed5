"""The npm package: its size, its types, and that it needs nothing else."""

from __future__ import annotations

import gzip
import json
import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

from .conftest import TOOLS

USE = """
import { SnapspaceViewer } from "./package/dist/snapspace-viewer";
const viewer = document.querySelector("snapspace-viewer")!;
viewer.setHandles({ head: { degrees: [0, 0, 30] } });
viewer.addEventListener("solve", ({ detail }) => detail.milliseconds.toFixed());
const made = new SnapspaceViewer();
made.src = "a.snapspace";
const name: string | undefined = made.model?.handles[0];
void name;
"""
WRONG = "viewer.setHandles({ head: { degrees: [0, 30] } });\n"


def test_the_script_is_small_and_needs_nothing_else(package: Path) -> None:
    (script,) = (package / "dist").glob("*.js")
    text = script.read_bytes()
    assert len(gzip.compress(text, 9)) <= 150_000
    assert re.search(rb"""\b(?:from|import)\s*["']""", text) is None
    assert "2010-2026 three.js authors" in text.decode(), "as its licence asks for"
    about = json.loads((package / "package.json").read_text(encoding="utf-8"))
    assert not [key for key in about if key.lower().endswith("dependencies")]


def test_names_files_and_version_are_those_of_the_package(package: Path) -> None:
    about = json.loads((package / "package.json").read_text(encoding="utf-8"))
    assert about["version"] == version("snapspace") and about["license"] == "MIT"
    for entry in about["exports"].values():
        for file in entry.values():
            assert (package / file).is_file()
    assert {"README.md", "LICENSE", "example.html"} <= {path.name for path in package.iterdir()}


@pytest.mark.parametrize(("text", "is_right"), [(USE, True), (USE + WRONG, False)])
def test_its_types_are_for_its_users(
    package: Path, tmp_path: Path, text: str, is_right: bool
) -> None:
    (tmp_path / "package").symlink_to(package)
    (tmp_path / "use.ts").write_text(text, encoding="utf-8")
    options = ["--ignoreConfig", "--noEmit", "--strict", "--target", "es2022", "--module", "esnext"]
    options += ["--moduleResolution", "bundler", "--lib", "es2022,dom", "--types", ""]
    script = (
        f"import sys; sys.path.insert(0, {str(TOOLS)!r})\nimport node\n"
        f"done = node.run(['node_modules/typescript/bin/tsc', *{options!r},"
        f" {str(tmp_path / 'use.ts')!r}])\nprint(done.stdout); sys.exit(done.returncode)"
    )
    checked = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (checked.returncode == 0) == is_right, checked.stdout + checked.stderr
    if not is_right:
        assert "use.ts" in checked.stdout
