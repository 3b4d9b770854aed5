"""Messages of the page about models that it cannot read."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import InterpolationModel, PosingModel

from .pages import OpenPage


def damaged(page: Path, folder: Path, old: str, new: str) -> str:
    text = page.read_text(encoding="utf-8")
    assert old in text
    path = folder / "damaged.html"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return path.as_uri()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('octet-stream">', 'octet-stream">%%%', "The model in this page is damaged"),
        ('octet-stream">', 'octet-stream">AAAA', "The model in this page is damaged"),
        ('<script id="model"', '<script id="none"', "Drop a .snapspace file here"),
    ],
)
def test_a_damaged_page_says_so(
    posing_page: Path, tmp_path: Path, opened: OpenPage, old: str, new: str, message: str
) -> None:
    page = opened(damaged(posing_page, tmp_path, old, new))
    assert message in page.text("#message")
    assert page.page.get_by_role("button", name="Open a model").first.is_visible()


def test_one_changed_letter_of_the_model_is_noticed(
    posing_page: Path, tmp_path: Path, opened: OpenPage
) -> None:
    """The arrays keep their sizes, but the shape would be wrong."""
    text = posing_page.read_text(encoding="utf-8")
    place = text.index("</script>", text.index('id="model"')) - 4001
    letter = "B" if text[place] == "A" else "A"
    path = tmp_path / "changed.html"
    path.write_text(text[:place] + letter + text[place + 1 :], encoding="utf-8")
    page = opened(path.as_uri())
    assert "The model in this page is damaged. Export the page again." in page.text("#message")


def test_pages_of_earlier_versions_have_no_checksum(
    posing_page: Path, tmp_path: Path, opened: OpenPage
) -> None:
    page = opened(damaged(posing_page, tmp_path, 'data-crc32="', 'data-none="'))
    assert page.run("snapspace.kind") == "posing"


@pytest.fixture
def built(
    posing_model: PosingModel, blending_model: InterpolationModel, tmp_path: Path
) -> dict[str, Path]:
    """Model files, as `snapspace build` writes them, by kind."""
    return {
        "interpolation": blending_model.save(tmp_path / "poses.snapspace"),
        "posing": posing_model.save(tmp_path / "bar.snapspace"),
    }


def test_files_are_opened_and_bad_ones_refused(
    posing_page: Path, tmp_path: Path, opened: OpenPage, built: dict[str, Path]
) -> None:
    page = opened(posing_page.as_uri())
    bad = tmp_path / "teapot.snapspace"
    bad.write_bytes(b"this is no model at all")
    chosen = page.page.locator("footer input[type=file]")
    chosen.set_input_files(bad)
    page.page.wait_for_selector("#message.error")
    assert "not a complete Snapspace model" in page.text("#message")
    assert page.run("snapspace.kind") == "posing", "the model that was open stays"
    for kind, file in built.items():
        chosen.set_input_files(file)
        page.wait(f"snapspace.kind === '{kind}' && !snapspace.message")
        assert page.text(".hud h1") == file.stem
        assert page.page.is_hidden("#message")
