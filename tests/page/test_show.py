"""`model.show()` in a notebook."""

from __future__ import annotations

import base64
import gzip
import html
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel
from snapspace.page import page_with_model, show

from ..page_numbers import numbers
from .framed import dragged, ready
from .pages import OpenPage


class Elements(HTMLParser):
    """The elements of an output with their attributes, and the text that is not in attributes."""

    def __init__(self, output: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.words = ""
        self.feed(output)
        self.close()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attributes)))

    def handle_data(self, data: str) -> None:
        self.words += data


def packed_page(opener: str | None) -> str:
    """The page that a frame's document unpacks."""
    found = re.search(r'atob\("([A-Za-z0-9+/=]+)"\)', opener or "")
    assert found is not None
    return gzip.decompress(base64.b64decode(found[1])).decode()


def test_the_output_is_the_page(posing_model: PosingModel) -> None:
    title = 'a "bar" <b> & </iframe>'
    output = posing_model.show(title=title, height=400)._repr_html_()
    read = Elements(output)
    (frame, attributes), *others = read.elements
    assert frame == "iframe" and not others
    assert packed_page(attributes["srcdoc"]) == page_with_model(posing_model, title=title)
    assert attributes["title"] == title
    assert "height: 400px" in (attributes["style"] or "")
    assert not re.search(r"https?:|localhost|127\.0\.0\.1", html.unescape(output).split("atob")[0])


def test_the_frame_cannot_reach_the_notebook(posing_model: PosingModel) -> None:
    # scripts together with the notebook's origin would be no sandbox
    ((_, attributes),) = Elements(posing_model.show()._repr_html_()).elements
    assert attributes["sandbox"] == "allow-scripts"


def test_the_text_for_untrusted_notebooks_says_what_to_do(posing_model: PosingModel) -> None:
    words = Elements(posing_model.show()._repr_html_()).words
    assert "trusted" in words and "run again" in words
    assert "export_html" in repr(posing_model.show())


def test_the_output_is_small_and_always_the_same(posing_model: PosingModel) -> None:
    output = posing_model.show(title="bar")._repr_html_()
    assert len(output) < 0.7 * len(page_with_model(posing_model, title="bar"))
    assert output == posing_model.show(title="bar")._repr_html_()


def test_a_long_output_warns(posing_model: PosingModel, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(show, "MOST_BYTES", 100_000)
    with pytest.warns(UserWarning, match=r"fewer than 20 dimensions .*leading\(d\)") as warned:
        posing_model.show()
    assert warned[0].filename == __file__


def test_low_frames_are_refused(posing_model: PosingModel) -> None:
    with pytest.raises(ValueError, match="height is 5 pixels"):
        posing_model.show(height=5)


def test_two_pages_run_inside_another_page(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    path = tmp_path / "notebook.html"
    first = posing_model.show(height=240)._repr_html_()
    second = posing_model.leading(8).show(title="fewer", height=220)._repr_html_()
    mark = "<script>window.snapspace = { ready: true }</script>"
    path.write_text(f"<!doctype html>{mark}{first}{second}", encoding="utf-8")
    page = opened(path.as_uri())
    one, two = (ready(frame) for frame in page.page.frames[1:])
    assert one.evaluate("snapspace.kind") == "posing"
    assert two.evaluate("[origin, document.title, snapspace.session.dimension]") == [
        "null",
        "fewer",
        8,
    ]
    before = numbers(two, "snapspace.shown()")
    assert dragged(page.page, one, 1, 40, -30) > 0.02
    np.testing.assert_array_equal(numbers(two, "snapspace.shown()"), before)
