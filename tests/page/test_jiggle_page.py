"""The page swings: steps in time in a browser, with real pointer events."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from snapspace import InterpolationModel, PosingModel

from .choosing_page import tool
from .pages import OpenPage, Page
from .test_posing_page import assert_shown

SPEED = "snapspace.session.speed"


def jiggle(page: Page) -> None:
    page.page.get_by_role("button", name="Jiggle", exact=True).click()


def damp(page: Page) -> None:
    """Lets a body that swings come to rest soon."""
    page.page.get_by_label("Frequency", exact=True).fill("4")
    page.page.get_by_label("Damping", exact=True).fill("0.5")


def test_a_body_swings_after_its_handle_and_rests_in_the_static_shape(
    posing_model: PosingModel, posing: Page
) -> None:
    jiggle(posing)
    posing.wait(f"{SPEED} === 0")  # nothing moves before it is touched
    posing.drag(posing.run("snapspace.handle(1)"), 60, -50)
    assert posing.run(SPEED) > 0.0, "it still swings when the pointer is released"
    swinging = posing.shown()
    damp(posing)
    posing.wait(f"{SPEED} === 0")
    assert np.abs(posing.shown() - swinging).max() > 0.0
    assert_shown(posing_model, posing)
    moved = posing.motions()
    posing.page.keyboard.press("Control+z")
    assert posing.motions() != moved, "the drag is one step of undo"
    posing.rest()
    assert_shown(posing_model, posing)


def test_gravity_bends_the_body_until_jiggle_is_off(
    posing_model: PosingModel, posing: Page
) -> None:
    rest = posing.shown()
    if posing.page.locator("#jiggle").get_attribute("aria-pressed") == "false":
        posing.page.keyboard.press("j")
        damp(posing)
    gravity = posing.page.get_by_label("Gravity", exact=True)
    gravity.fill("3")
    assert "3.0 diagonals/s²" in posing.text("#panel")
    posing.wait(f"{SPEED} > 0")
    posing.wait(f"{SPEED} < 0.05")
    down = (posing.shown() - rest)[:, 2]  # z is up
    diagonal = posing_model.problem.mesh.diagonal
    assert down.min() < -1e-3 * diagonal and down.mean() < 0.0
    tool(posing, "y up")
    posing.rest()
    down = (posing.shown() - rest).mean(axis=0)
    assert down[1] < -1e-4 * diagonal and abs(down[2]) < abs(down[1]), "it pulls down again"
    gravity.fill("0")
    posing.page.keyboard.press("j")
    posing.settle()
    assert_shown(posing_model, posing)


def test_blends_swing(
    blending_model: InterpolationModel, blending_page: Path, opened: OpenPage
) -> None:
    page = opened(blending_page.as_uri())
    jiggle(page)
    name = blending_model.problem.poses.names[1]
    page.page.get_by_role("slider", name=name).fill("0.6")
    page.wait(f"{SPEED} > 0")
    damp(page)
    page.wait(f"{SPEED} === 0")
    session = blending_model.session()
    session.blend(page.run("snapspace.session.weights"))
    shape = blending_model.surface.vertices(session.vertices)
    close = 1e-4 * blending_model.problem.mesh.diagonal
    assert np.abs(page.shown() - shape).max() < close
