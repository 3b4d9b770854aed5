"""The server polishes a released handle's shape. The next drag starts from the live one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel

from ..server.in_process import started
from .choosing_page import press
from .frames import session_at_frame
from .pages import OpenPage, Page
from .test_jiggle_page import SPEED, damp, jiggle
from .test_posing_page import assert_shown
from .test_take_away import taken


@pytest.fixture(scope="module")
def address(posing_model: PosingModel, tmp_path_factory: pytest.TempPathFactory) -> str:
    return started(model=posing_model, folder=tmp_path_factory.mktemp("polish"))


def polished(page: Page, model: PosingModel) -> np.ndarray:
    """The page's frame after the polish of a session, on the surface."""
    session = session_at_frame(page, model)
    found = session.polish(iterations=10)
    assert f"moved {100 * found.moved_relative:.2g}"[:7] in page.text(".hud")
    level = page.run("document.querySelector('.badge').dataset.level")
    assert level == ("rough" if found.moved_relative > 0.01 else "good"), "it may have moved far"
    shape: np.ndarray = found.vertices[model.problem.mesh.surface_vertices]
    return shape


def test_the_page_in_one_file_has_the_keys(address: str, opened: OpenPage, tmp_path: Path) -> None:
    page = opened(address)
    page.drag(page.run("snapspace.handle(1)"), 30, -20)
    page.page.get_by_role("button", name="Add key").click()
    alone = opened(taken(page, "HTML", tmp_path).as_uri())
    (state,) = alone.run("snapspace.timeline.timeline.keys.map((key) => key.state)")
    np.testing.assert_allclose(state[1]["translation"], page.motions()[1][1], atol=1e-6)


def test_a_released_handle_is_polished(
    address: str, posing_model: PosingModel, opened: OpenPage
) -> None:
    page = opened(address)
    # the first handle carries the shape along
    for handle, (dx, dy) in {1: (-40, -50), 0: (-20, 30)}.items():
        page.drag(page.run(f"snapspace.handle({handle})"), dx, dy)
        page.wait("document.querySelector('.hud').innerText.includes('polished, moved')")
        page.rest()
        expected = polished(page, posing_model)
        assert np.abs(page.shown() - expected).max() < 1e-4 * posing_model.problem.mesh.diagonal
    x, y = page.run("snapspace.handle(1)")
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 10, y + 6, steps=3)
    page.wait("!document.querySelector('.hud').innerText.includes('polished')")
    assert_shown(posing_model, page)
    page.page.mouse.up()
    page.wait("document.querySelector('.hud').innerText.includes('polished, moved')")
    for come_to_rest in (lambda: page.page.keyboard.press("Control+z"), page.page.reload):
        come_to_rest()
        page.wait("snapspace.kind === 'posing'")
        page.wait("document.querySelector('.hud').innerText.includes('polished, moved')")
        page.rest()
        expected = polished(page, posing_model)
        assert np.abs(page.shown() - expected).max() < 1e-4 * posing_model.problem.mesh.diagonal
    page.page.get_by_role("button", name="Polish", exact=True).click()
    assert "polished" not in page.text(".hud")
    assert_shown(posing_model, page)


def test_the_badge_stays_hidden_at_rest(address: str, opened: OpenPage) -> None:
    """The shape at rest is the full solution."""
    page = opened(address)
    page.drag(page.run("snapspace.handle(1)"), -40, -50)
    page.wait("document.querySelector('.hud').innerText.includes('polished, moved')")
    page.page.keyboard.press("r")
    page.wait("document.querySelector('.badge').hidden")
    page.rest()
    page.page.wait_for_timeout(500)  # the badge of a polish would be there
    assert page.run("document.querySelector('.badge').hidden")


def test_what_gravity_bends_is_not_polished(address: str, opened: OpenPage) -> None:
    """The server would straighten it."""
    page = opened(address)
    rest = page.shown()
    jiggle(page)
    damp(page)
    page.page.get_by_label("Gravity", exact=True).fill("3")
    page.wait(f"{SPEED} > 0")
    page.wait(f"{SPEED} === 0")
    page.page.wait_for_timeout(300)
    bent = page.shown()
    assert np.abs(bent - rest).max() > 1e-3 and "%" not in page.text(".hud")
    press(page, "Reset")
    page.wait(f"{SPEED} > 0")
    page.wait(f"{SPEED} === 0")
    np.testing.assert_allclose(page.shown(), bent, atol=0.05 * np.abs(bent - rest).max())
    page.page.get_by_label("Gravity", exact=True).fill("0")
    page.drag(page.run("snapspace.handle(1)"), -40, -50)
    page.wait("document.querySelector('.hud').innerText.includes('polished')")
