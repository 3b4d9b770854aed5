"""`model.show()` in a notebook."""

from __future__ import annotations

import html
import re
from pathlib import Path

import pytest

from snapspace import PosingModel
from snapspace.page import page_with_model

from .pages import OpenPage


def test_the_output_is_the_page(posing_model: PosingModel) -> None:
    shown = posing_model.show(title='a "bar"', height=400)
    output = shown._repr_html_()
    found = re.fullmatch(
        r'<iframe srcdoc="([^"]*)" title="([^"]*)" style="[^"]*"></iframe>', output
    )
    assert found is not None
    assert html.unescape(found[1]) == page_with_model(posing_model, title='a "bar"')
    assert html.unescape(found[2]) == 'a "bar"'
    assert "export_html" in repr(shown)
    with pytest.raises(ValueError, match="height is 5 pixels"):
        posing_model.show(height=5)


def test_it_runs_inside_of_another_page(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    path = tmp_path / "notebook.html"
    output = posing_model.show()._repr_html_()
    ready = "<script>window.snapspace = { ready: true }</script>"
    path.write_text(f"<!doctype html>{ready}{output}", encoding="utf-8")
    page = opened(path.as_uri())
    page.wait("Boolean(frames[0].snapspace && frames[0].snapspace.ready)")
    assert page.run("frames[0].snapspace.kind") == "posing"
