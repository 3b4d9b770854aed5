"""Exported pages, and the page that the package carries."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from snapspace import PosingModel, export_html
from snapspace.page import page_file, page_with_model
from snapspace.page.page_file import page_html

from .tools import tool

build_page = tool("build_page")


def test_the_page_is_of_the_present_sources() -> None:
    assert build_page.is_current(), "web/ changed; run: python tools/build_page.py"
    assert len(page_html().encode()) < 500_000, "page and core"


def test_a_package_without_its_page_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page_file, "_FILE", tmp_path / "page.html")
    with pytest.raises(ValueError, match=r"has no page; run `python tools/build_page.py`"):
        page_file.page_html.__wrapped__()


def test_the_page_has_the_licences_of_what_it_contains() -> None:
    page = page_html()
    for author in ("three.js authors", "Matt DesLauriers"):
        assert re.search(rf"Copyright .*{author}", page)
    assert page.count("Permission is hereby granted") == 2


def test_the_page_asks_for_nothing() -> None:
    page = page_html()
    assert not re.search(r'<(script|link|img|iframe)[^>]*\s(src|href)="(?!data:)', page)
    assert "default-src 'none'" in page


def test_the_lock_names_no_registry() -> None:
    lock = build_page.LOCK.read_text(encoding="utf-8")
    assert "resolved" not in lock and "http" not in re.sub(r'"(url|funding)": .*', "", lock)


def test_titles_are_escaped(posing_model: PosingModel, tmp_path: Path) -> None:
    page = page_with_model(posing_model, title="a <b> & </script>")
    assert "<title>a &lt;b&gt; &amp; &lt;/script&gt;</title>" in page
    assert page.count('<script id="model"') == 1
    path = export_html(posing_model, tmp_path / "bar.html")
    assert "<title>bar</title>" in path.read_text(encoding="utf-8")


def test_other_extensions_are_refused(posing_model: PosingModel, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"out\.pdf: the name of a page must end in \.html or"):
        export_html(posing_model, tmp_path / "out.pdf")
    with pytest.raises(ValueError, match="cannot be written"):
        export_html(posing_model, tmp_path / "nowhere" / "out.html")
