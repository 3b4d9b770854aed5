"""The axes in the corner, drags that snap, and arrows along a handle's own axes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel

from .pages import OpenPage, Page
from .test_interaction import AXES, arrow_directions, shift_of
from .test_posing_page import assert_shown

HEAD = 1
AWAY = "snapspace.stage.camera.position.clone().sub(snapspace.stage.controls.target).normalize()"
OF_THE_MODEL = f"{AWAY}.applyQuaternion(snapspace.stage.root.quaternion.clone().invert()).toArray()"


def turn_of(page: Page) -> np.ndarray:
    """The head's rotation matrix."""
    rotation = page.run(f"snapspace.session.motion({HEAD}).rotation")
    return np.array(rotation).reshape(3, 3)


def step_of(page: Page) -> float:
    """The length that drags are rounded to, as the tip tells it."""
    tip = page.page.get_by_role("button", name="Snap").get_attribute("title")
    return float(tip.split()[3])


def test_a_press_on_an_axis_looks_from_there(posing: Page) -> None:
    for axis, name in enumerate("xyz"):
        for sign, words in ((1, name), (-1, f"minus {name}")):
            end = posing.page.get_by_role("button", name=f"Look along {words}", exact=True)
            end.focus()
            posing.page.keyboard.press("Enter")
            posing.settle()
            direction = np.array(posing.run(OF_THE_MODEL))
            assert direction[axis] * sign > 0.999, (name, sign, direction)
    posing.run("snapspace.stage.look()")
    posing.page.get_by_role("button", name="Look along y", exact=True).click()
    assert posing.run(OF_THE_MODEL)[1] > 0.999, "the pointer does as well"
    posing.run("snapspace.stage.look()")


def test_the_axes_in_the_corner_turn_with_the_camera(posing: Page) -> None:
    posing.run("snapspace.stage.look()")
    posing.drag((30, 300), 90, -40)
    seen = posing.run(
        "[...document.querySelectorAll('.axis-widget line')].map((line) => "
        "[line.getAttribute('stroke'), +line.getAttribute('x2'), -line.getAttribute('y2')])"
    )
    lines = {color: np.array(end) for color, *end in seen}
    for axis, color in enumerate(AXES.values()):
        unit = ["0", "0", "0"]
        unit[axis] = "1"
        script = (
            f"snapspace.stage.scene.position.clone().set({','.join(unit)})"
            ".transformDirection(snapspace.stage.root.matrixWorld)"
            ".transformDirection(snapspace.stage.camera.matrixWorldInverse).toArray()"
        )
        expected = np.array(posing.run(script))[:2]
        np.testing.assert_allclose(lines[color] / 27, expected, atol=0.01)
    posing.run("snapspace.stage.look()")


@pytest.mark.parametrize("turn", [False, True])
def test_drags_snap(posing_model: PosingModel, posing: Page, turn: bool) -> None:
    page = posing
    page.page.keyboard.press("s")
    assert page.page.get_by_role("button", name="Snap").get_attribute("aria-pressed") == "true"
    page.drag(page.run(f"snapspace.handle({HEAD})"), 47, -23, shift=turn)
    if turn:
        cosine = (np.trace(turn_of(page)) - 1) / 2
        steps = np.degrees(np.arccos(cosine)) / 5
        np.testing.assert_allclose(shift_of(page), 0, atol=1e-12, err_msg="a turn moves nothing")
    else:
        length = step_of(page)
        size = page.run("snapspace.session.model.diagonal")
        assert size / 100 < length <= size / 40 * (1 + 1e-6)
        assert f"{length:e}"[0] in "125" and set(f"{length:.3e}"[2:5]) == {"0"}
        steps = shift_of(page) / length
        np.testing.assert_allclose(turn_of(page), np.eye(3), atol=1e-6)
    assert np.abs(steps).max() > 0.5
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-3)
    assert_shown(posing_model, page)
    page.page.keyboard.press("s")
    page.drag(page.run(f"snapspace.handle({HEAD})"), 11, 7)
    free = shift_of(page) / step_of(page)
    assert np.abs(free - np.round(free)).max() > 1e-3, "no longer"


def test_arrows_are_along_the_handles_own_axes(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    page.page.keyboard.press("2")
    page.page.get_by_label("Turn z, degrees").fill("30")
    page.page.keyboard.press("Tab")
    page.settle()
    to_stage = np.array(page.run("snapspace.stage.root.matrixWorld.elements")).reshape(4, 4)
    to_stage = to_stage.T[:3, :3] / np.linalg.norm(to_stage[0, :3])
    np.testing.assert_allclose(np.abs(arrow_directions(page)), np.abs(to_stage.T), atol=1e-5)
    page.page.locator("canvas").first.focus()
    page.page.keyboard.press("l")
    page.settle()
    own = (to_stage @ turn_of(page)).T
    np.testing.assert_allclose(np.array(arrow_directions(page)), own, atol=1e-5)
    page.page.keyboard.press("l")
    page.settle()
    np.testing.assert_allclose(np.abs(arrow_directions(page)), np.abs(to_stage.T), atol=1e-5)
