"""Keys outlive a reload and other handles, but not another body."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace.mesh import write_tets

from .choosing_page import BAR, bar_with_ends, compute, press, take_ends, wait_for_text
from .choosing_page import wait_for_last_model as wait_for_it
from .pages import OpenPage, Page

KEYS = "snapspace.timeline.timeline.keys"
SHIFTS = f"{KEYS}.map((key) => key.state.map((motion) => motion.translation[2]))"


def add_two_keys(page: Page) -> None:
    press(page, "Add key")
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    press(page, "Add key")


def pictures(page: Page) -> list[str]:
    """The pictures of two keys."""
    page.wait("document.querySelectorAll('.key img').length === 2")
    found: list[str] = page.run("[...document.querySelectorAll('.key img')].map(({ src }) => src)")
    return found


def loops(page: Page) -> bool:
    button = page.page.get_by_role("button", name="Loop", exact=True)
    return button.get_attribute("aria-pressed") == "true"


def test_a_reload_keeps_keys(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    add_two_keys(page)
    press(page, "Loop")
    before = page.run(SHIFTS)
    page.page.reload()
    page.wait("snapspace.kind === 'posing'")
    for shifts, there in zip(page.run(SHIFTS), before, strict=True):
        assert shifts == pytest.approx(there)
    assert loops(page)
    shape = page.shown()
    first, second = pictures(page)
    assert first != second, "each is of its own state"
    assert (page.shown() == shape).all(), "the present state is back"
    press(page, "Add key")
    assert page.run(f"{KEYS}.map((key) => key.time)") == [0, 1, 2], "no key is replaced"
    press(page, "Delete")
    for _ in range(2):
        page.page.locator(".key").first.click()
        press(page, "Delete")
    page.page.reload()
    page.wait("snapspace.kind === 'posing'")
    assert page.run(KEYS) == [], "deleted keys do not come back"
    add_two_keys(page)
    page.page.goto("about:blank")
    page.open()
    assert page.run(KEYS) == [], "a page that is opened again begins without keys"


def test_a_reload_keeps_keys_of_blends(blending_page: Path, opened: OpenPage) -> None:
    page = opened(blending_page.as_uri())
    press(page, "Add key")
    before = page.run(f"{KEYS}[0].state")
    page.page.reload()
    page.wait("snapspace.kind === 'interpolation'")
    assert page.run(f"{KEYS}[0].state") == pytest.approx(before)


def test_keys_outlive_a_handle_but_not_the_body(
    bar_server: str, tmp_path: Path, opened: OpenPage
) -> None:
    page = bar_with_ends(opened, bar_server)
    compute(page)
    page.wait("snapspace.kind === 'posing'")
    wait_for_it(page)
    add_two_keys(page)
    before = page.run(SHIFTS)
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    name = page.page.get_by_label("Name of the handle").first
    name.fill("base")
    name.press("Enter")
    press(page, "Compute")
    page.wait("snapspace.kind === 'posing'")
    wait_for_text(page, "#panel", "Keys no longer move foot.")
    assert [head for _, head in page.run(SHIFTS)] == pytest.approx([head for _, head in before])
    wait_for_it(page)

    write_tets(tmp_path / "other.mesh", BAR)
    page.page.set_input_files("footer input", tmp_path / "other.mesh")
    page.wait("snapspace.kind === 'choosing'")
    assert page.text(".hud h1") == "other"
    take_ends(page)
    compute(page)
    page.wait("snapspace.kind === 'posing'")
    assert page.run(KEYS) == []
    assert "The keys" not in page.text("#panel")
