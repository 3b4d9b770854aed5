"""The npm package: sizes, types, and three.js from elsewhere."""

from __future__ import annotations

import gzip
import json
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest

from .conftest import TOOLS, WEB
from .site import PAGE, Viewer, site

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


def test_the_module_is_small_and_three_js_comes_from_elsewhere(package: Path) -> None:
    module = (package / "dist" / "snapspace-viewer.js").read_bytes()
    bundle = (package / "dist" / "snapspace-viewer.bundle.js").read_bytes()
    assert len(gzip.compress(module, 9)) <= 150_000
    assert b'from"three"' in module.replace(b" ", b"")
    assert b'from"three' not in bundle.replace(b" ", b"")


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


def test_a_page_with_its_own_three_js_uses_the_module(
    viewer: Viewer, folder: Path, chromium: Any
) -> None:
    (folder / "three").unlink(missing_ok=True)
    (folder / "three").symlink_to(WEB / "node_modules" / "three")
    imports = {"three": "./three/build/three.module.js", "three/addons/": "./three/examples/jsm/"}
    head = (
        f'<script type="importmap">{json.dumps({"imports": imports})}</script>'
        '<script type="module" src="dist/snapspace-viewer.js"></script>'
    )
    body = '<snapspace-viewer src="posing.snapspace"></snapspace-viewer>'
    (folder / "module.html").write_text(PAGE.format(head=head, body=body), encoding="utf-8")
    with site(folder) as address:
        viewer.open(f"{address}/module.html")
        assert viewer.run("viewer.model.kind") == "posing"
