"""The sources of the docs site, which `make docs` builds."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

import snapspace as ss

DOCS = Path(__file__).parent.parent.parent / "docs"


def test_the_reference_has_every_public_name_once() -> None:
    text = (DOCS / "api.md").read_text(encoding="utf-8")
    listed = re.findall(r"^   (\w+)$", text, re.MULTILINE)
    assert sorted([*listed, "MATERIALS"]) == sorted(ss.__all__)
    assert "`MATERIALS`" in text


def test_every_page_is_in_the_contents() -> None:
    pages = {path.stem for path in DOCS.iterdir() if path.suffix in (".md", ".ipynb")} - {"index"}
    index = (DOCS / "index.md").read_text(encoding="utf-8")
    listed = re.findall(r"^([\w-]+)$", index, re.MULTILINE)
    assert sorted(listed) == sorted(pages)


def test_files_that_pages_show_exist() -> None:
    shown = [
        (page, name)
        for page in DOCS.glob("*.md")
        for name in re.findall(r"\{literalinclude\} (\S+)", page.read_text(encoding="utf-8"))
    ]
    assert len(shown) >= 4
    for page, name in shown:
        assert (page.parent / name).is_file(), f"{page.name}: {name}"


def test_the_notebook_is_saved_without_outputs() -> None:
    """They would differ from run to run; building the site runs it."""
    notebook = json.loads((DOCS / "tutorial-researcher.ipynb").read_text(encoding="utf-8"))
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) > 5
    assert not any(cell["outputs"] or cell["execution_count"] for cell in cells)


def test_subspaces_of_polynomials_and_of_parts_make_models(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = (DOCS / "own-subspace.md").read_text(encoding="utf-8")
    polynomials, parts = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    names: dict[str, Any] = {}
    exec(polynomials, names)
    assert 0 < float(capsys.readouterr().out) < 0.05
    exec(parts, names)
    assert names["wide"].dimension == 20 > len(names["snapshots"])
    wide, whole = (
        ss.validate(ss.reduce(names["problem"], names[name], energy="exact"), samples=4).error
        for name in ("wide", "whole")
    )
    assert wide.mean() < 0.6 * whole.mean()
