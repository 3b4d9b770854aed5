"""Numbers, named views and the sheet of shortcuts."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import PosingModel

from .pages import Page
from .test_posing_page import assert_shown


def test_motions_are_typed(posing_model: PosingModel, posing: Page) -> None:
    page = posing
    page.page.get_by_role("button", name="head", exact=True).click()
    page.page.get_by_label("Turn z, degrees").fill("20")
    page.page.get_by_label("Move x, in the unit of the mesh").fill("0.15")
    page.page.keyboard.press("Tab")
    page.settle()
    handle = posing_model.problem.handles.index("head")
    euler, shift = page.motions()[handle]
    assert euler == pytest.approx([0.0, 0.0, np.deg2rad(20.0)], abs=1e-9)
    assert shift == pytest.approx([0.15, 0.0, 0.0], abs=1e-9)
    assert_shown(posing_model, page)
    field = page.page.get_by_label("Turn z, degrees")
    field.press("ArrowUp")
    field.press("Shift+ArrowUp")
    page.settle()
    assert page.motions()[handle][0][2] == pytest.approx(np.deg2rad(31.0), abs=1e-6)
    before = page.motions()
    for wrong in ("", "1e300"):
        field.fill(wrong)
        page.page.keyboard.press("Tab")
        assert page.motions() == before and field.input_value() == "31", f"'{wrong}' does not stay"
    page.page.get_by_label("Move x, in the unit of the mesh").fill("")
    page.page.get_by_label("Move y, in the unit of the mesh").fill("1e300")
    page.page.get_by_label("Move z, in the unit of the mesh").fill("0.1")
    page.page.keyboard.press("Tab")
    page.settle()
    assert page.motions()[handle][1] == pytest.approx([0.15, 0.0, 0.1]), "the others count"
    page.page.keyboard.press("Tab")
    undo = page.page.get_by_role("button", name="Undo", exact=True)
    undo.click()
    assert page.motions()[handle][1] == pytest.approx([0.15, 0.0, 0.0]), "no refused step"
    reset = page.page.get_by_role("button", name="Reset", exact=True)
    for _ in range(3):
        reset.click()
    undo.click()
    assert page.motions()[handle][1][0] == pytest.approx(0.15), "only one reset changed anything"


def test_a_number_is_for_the_handle_that_it_was_typed_for(posing: Page) -> None:
    posing.page.keyboard.press("2")
    posing.page.get_by_label("Move z, in the unit of the mesh").fill("0.1")
    posing.page.mouse.click(*posing.run("snapspace.handle(2)"))  # with the focus in the field
    posing.settle()
    assert posing.run("document.querySelectorAll('.list button')[2].ariaPressed") == "true"
    shifts = [shift for _, shift in posing.motions().values()]
    assert shifts == [[0, 0, 0], pytest.approx([0, 0, 0.1]), [0, 0, 0]]


def test_the_hint_is_that_of_the_mode(posing: Page) -> None:
    def hint(mode: str) -> str:
        posing.page.get_by_role("radio", name=mode, exact=True).click()
        return posing.text("#panel .figures >> nth=0")

    assert "to move it" in hint("Move")
    assert "to turn it" in hint("Turn") and "move it" not in hint("Turn")
    assert "elsewhere" not in hint("Pull"), "a press elsewhere on the surface pulls"
    assert "1 to 9" in posing.page.locator("canvas").get_attribute("aria-label")


def test_views_look_along_the_axes(posing: Page) -> None:
    away = "snapspace.stage.camera.position.clone().sub(snapspace.stage.controls.target)"
    for name, key, axis in (("Front", "8", 2), ("Side", "9", 0), ("Top", "7", 1)):
        for by_key in (False, True):
            posing.run("snapspace.stage.look()")
            if by_key:
                posing.page.keyboard.press(f"Numpad{key}")
            else:
                posing.page.get_by_role("button", name=name, exact=True).click()
            direction = np.asarray(posing.run(f"{away}.normalize().toArray()"))
            assert direction[axis] > 0.999, (name, direction)
    posing.run("snapspace.stage.look()")


def test_the_sheet_lists_the_keys(posing: Page) -> None:
    sheet = posing.page.get_by_role("dialog", name="Shortcuts")
    posing.page.keyboard.press("?")
    assert "undo" in sheet.inner_text()
    color = sheet.evaluate("(e) => getComputedStyle(e).backgroundColor")
    assert color.startswith("rgb("), "opaque: no text of the panel shows through"
    posing.page.keyboard.press("Escape")
    assert not sheet.is_visible()
    posing.page.get_by_role("button", name="Shortcuts").click()
    sheet.get_by_role("button", name="Close").click()
    assert not sheet.is_visible()
