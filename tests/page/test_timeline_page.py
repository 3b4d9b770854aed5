"""Keys in time: added, played, saved and opened in a browser, and solved again by Python."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from snapspace import InterpolationModel, PosingModel, read_timeline

from .pages import OpenPage, Page
from .test_take_away import taken

TIMELINE = "snapspace.timeline"


def button(page: Page, name: str) -> Any:
    return page.page.get_by_role("button", name=name, exact=True)


def opened_keys(page: Page, content: Any) -> None:
    text = content if isinstance(content, str) else json.dumps(content)
    page.page.locator("input[accept='.json']").set_input_files(
        {"name": "keys.json", "mimeType": "application/json", "buffer": text.encode()}
    )


def test_keys_are_played_by_solving_and_saved_for_python(
    posing_model: PosingModel, posing_page: Path, opened: OpenPage, tmp_path: Path
) -> None:
    page = opened(posing_page.as_uri())
    button(page, "Add key").click()
    rest = page.shown()
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    button(page, "Add key").click()
    posed, motions = page.shown(), page.motions()
    assert page.run(f"{TIMELINE}.timeline.keys.map((key) => key.time)") == [0, 1]
    pictures = page.page.locator(".key img")
    assert pictures.count() == 2
    assert pictures.nth(0).get_attribute("src") != pictures.nth(1).get_attribute("src")

    page.page.locator(".key").first.click()
    page.settle()
    np.testing.assert_allclose(page.shown(), rest, atol=1e-4)
    button(page, "Play keys").click()
    page.wait(f"!{TIMELINE}.isPlaying")
    page.settle()
    np.testing.assert_allclose(page.shown(), posed, atol=1e-3 * np.abs(posed - rest).max())
    page.page.keyboard.press("Control+z")
    page.settle()
    assert page.motions() != motions, "a film is one step of undo"

    timeline = read_timeline(taken(page, "Save keys", tmp_path))
    assert [key.time for key in timeline.keys] == [0.0, 1.0] and timeline.kind == "posing"
    session = posing_model.session()
    frames = [session.vertices for _ in session.animate(timeline, frames=3)]
    page.run("(document.querySelector('[aria-label=Time]').value = 0.5, null)")
    page.page.get_by_label("Time", exact=True).dispatch_event("input")
    page.settle()
    wanted = posing_model.surface.vertices(frames[1])
    np.testing.assert_allclose(page.shown(), wanted, atol=2e-3 * np.abs(posed - rest).max())


def test_keys_move_hold_and_go(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    head = {"degrees": [0, 0, 20], "translation": [0, 0, 0.1]}
    keys = [{"time": t, "handles": {"head": head} if t else {}} for t in (0, 1, 2)]
    content = {"format": "snapspace-timeline", "version": 1, "kind": "posing", "keys": keys}
    opened_keys(page, content)
    page.wait(f"{TIMELINE}.timeline.keys.length === 3")
    page.page.locator(".key").nth(1).click()
    page.page.get_by_label("Time of the key in seconds").fill("1.5")
    page.page.keyboard.press("Tab")
    page.page.get_by_label("How the next key is approached").select_option("hold")
    assert page.run(f"{TIMELINE}.timeline.keys.map((key) => [key.time, key.easing])") == [
        [0, "smooth"],
        [1.5, "hold"],
        [2, "smooth"],
    ]
    children = "snapspace.stage.root.children.filter((child) => child.visible).length"
    before = page.run(children)
    button(page, "Onion skin").click()
    page.settle()
    assert page.run(children) == before + 2, "the keys before and after"
    button(page, "Onion skin").click()
    button(page, "Delete").click()
    assert page.run(f"{TIMELINE}.timeline.keys.length") == 2

    for wrong, words in (
        ("{", "no JSON"),
        ({**content, "kind": "interpolation"}, "of kind interpolation"),
        ({**content, "keys": [{"time": 0, "handles": {"tail": head}}]}, "'tail'"),
        ({**content, "keys": keys[::-1]}, "no time after"),
    ):
        opened_keys(page, wrong)
        page.page.get_by_text(words).wait_for()
    assert page.run(f"{TIMELINE}.timeline.keys.length") == 2, "the keys before stay"


def test_weights_are_keys_too(
    blending_model: InterpolationModel, blending_page: Path, opened: OpenPage
) -> None:
    page = opened(blending_page.as_uri())
    names = blending_model.problem.poses.names
    keys = [{"time": k, "weights": {names[k]: 1.0}} for k in range(2)]
    opened_keys(
        page,
        {"format": "snapspace-timeline", "version": 1, "kind": "interpolation", "keys": keys},
    )
    page.wait(f"{TIMELINE}.timeline.keys.length === 2")
    page.page.locator("#play-keys").click()
    page.wait(f"!{TIMELINE}.isPlaying")
    page.settle()
    assert page.run("snapspace.session.weights") == [0, 1, 0]
