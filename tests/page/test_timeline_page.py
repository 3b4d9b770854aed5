"""Keys in time: added, played, saved and opened in a browser, and solved again by Python."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

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


def test_keys_are_moved_held_and_removed(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    head = {"degrees": [0, 0, 20], "translation": [0, 0, 0.1]}
    keys = [{"time": t, "handles": {"head": head} if t else {}} for t in (0, 1, 2)]
    content = {"format": "snapspace-timeline", "version": 1, "kind": "posing", "keys": keys}
    opened_keys(page, content)
    page.wait(f"{TIMELINE}.timeline.keys.length === 3")
    page.wait("document.querySelectorAll('.key img').length === 3")
    page.page.locator(".key").nth(1).click()
    when = page.page.get_by_label("Time of the key in seconds")
    when.fill("-1")
    page.page.keyboard.press("Tab")
    assert when.input_value() == "1", "a time that is refused does not stay"
    when.fill("1.5")
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
    focused = "[...document.querySelectorAll('.key')].indexOf(document.activeElement)"
    assert page.run(focused) == 1, "the focus goes to the key that took the place"

    for wrong, words in (
        ("{", "not JSON"),
        ({**content, "kind": "interpolation"}, "of kind interpolation"),
        ({**content, "keys": [{"time": 0, "handles": {"tail": head}}]}, "'tail'"),
        ({**content, "keys": keys[::-1]}, "no time after"),
        ({**content, "keys": [None]}, "Key 0 of the timeline is not an object"),
    ):
        opened_keys(page, wrong)
        page.page.get_by_text(words).wait_for()
    assert page.run(f"{TIMELINE}.timeline.keys.length") == 2, "the keys before stay"


def test_ghosts_do_not_shine_through_what_has_not_moved(
    posing_page: Path, opened: OpenPage, tmp_path: Path
) -> None:
    page = opened(posing_page.as_uri())
    keys = [{"time": t, "handles": {}} for t in (0, 1)]
    content = {"format": "snapspace-timeline", "version": 1, "kind": "posing", "keys": keys}
    opened_keys(page, content)
    page.wait(f"{TIMELINE}.timeline.keys.length === 2")
    page.settle()
    page.page.get_by_label("Width in pixels").fill("300")
    page.page.get_by_label("Height in pixels").fill("200")

    def picture() -> np.ndarray:
        with Image.open(taken(page, "PNG", tmp_path)) as seen:
            return np.asarray(seen.convert("RGBA"), np.int64)

    without = picture()
    button(page, "Onion skin").click()
    page.settle()
    assert page.run(
        "snapspace.stage.root.children.some((c) => c.children[0]?.material.uniforms.nearer)"
    )
    spots = np.abs(picture() - without).max(axis=2) > 3
    assert spots.mean() < 1e-4


def test_edits_end_the_film(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    undo = page.page.get_by_role("button", name="Undo", exact=True)
    end = {"head": {"translation": [0, 0, 0.2]}}
    keys = [{"time": t, "handles": end if t else {}} for t in (0, 2)]
    content = {"format": "snapspace-timeline", "version": 1, "kind": "posing", "keys": keys}
    opened_keys(page, {**content, "loop": True})
    page.page.keyboard.press("2")
    shift = "snapspace.session.motion(1).translation[2]"

    def edit_in_film(edit: Callable[[], None]) -> Any:
        """The motions after an edit, which no later picture may change."""
        button(page, "Play keys").click()
        page.wait(f"{TIMELINE}.isPlaying && {shift} > 0.01")
        edit()
        page.settle()
        edited = page.motions()
        assert not page.run(f"{TIMELINE}.isPlaying"), "the film ends"
        page.page.wait_for_timeout(100)
        assert page.motions() == edited
        return edited

    at_rest = edit_in_film(lambda: page.page.keyboard.press("r"))
    assert np.abs([shift for _, shift in at_rest.values()]).max() == 0.0
    undo.click()
    assert page.motions() != at_rest, "undo goes back into the film"

    def typed() -> None:
        page.page.get_by_label("Move y, in the unit of the mesh").fill("0.07")
        page.page.keyboard.press("Enter")

    assert edit_in_film(typed)[1][1][1] == pytest.approx(0.07)
    undo.click()
    assert page.motions()[1][1][1] == pytest.approx(0.0), "the film and the number: two steps"


def test_drop_downs_keep_their_keys(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    for key in "2k":
        page.page.keyboard.press(key)
    easing = page.page.get_by_label("How the next key is approached")
    easing.focus()
    for key in ("ArrowDown", "l", "s"):
        page.page.keyboard.press(key)
    page.settle()
    assert np.abs(page.motions()[1][1]).max() == 0.0, "no arrow moves the handle"
    for name in ("Own axes", "Snap"):
        assert button(page, name).get_attribute("aria-pressed") == "false"


def test_play_and_the_keys_end_each_other(many_poses_page: Path, opened: OpenPage) -> None:
    """A walk of three poses must not continue with the single pose of a key."""
    page = opened(many_poses_page.as_uri())
    play, film = button(page, "Play"), button(page, "Play keys")
    pressed = "(e) => e.getAttribute('aria-pressed') === 'true'"
    page.page.locator(".weight [type=range]").nth(1).fill("1")
    page.page.keyboard.press("k")
    alone = page.run("snapspace.session.weights")
    assert sorted(alone)[-2:] == [0, 1]
    button(page, "Mean").click()
    play.click()
    page.settle()
    page.page.locator(".key").click()
    for _ in range(3):
        page.settle()
    assert not play.evaluate(pressed) and page.run("snapspace.session.weights") == alone

    page.page.get_by_label("Time", exact=True).fill("2")
    page.page.locator(".pose").nth(5).click()
    page.page.locator(".weight [type=range]").nth(1).fill("0.5")
    page.page.keyboard.press("k")
    assert page.run(f"{TIMELINE}.timeline.keys.length") == 2
    play.click()
    page.settle()
    page.page.keyboard.press("p")
    page.settle()
    assert film.evaluate(pressed) and not play.evaluate(pressed)
    play.click()
    page.settle()
    assert play.evaluate(pressed) and not film.evaluate(pressed)
    assert "plays the keys" in page.page.locator("canvas").get_attribute("aria-label")
    page.page.keyboard.press("?")
    sheet = page.page.get_by_role("dialog", name="Shortcuts").inner_text()
    assert all(words in sheet for words in ("jiggle", "add a key, play the keys"))


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


def test_ghosts_stand_where_the_blend_does(
    blending_model: InterpolationModel, blending_page: Path, opened: OpenPage
) -> None:
    page = opened(blending_page.as_uri())
    button(page, "Add key").click()
    name = blending_model.problem.poses.names[1]
    page.page.get_by_role("slider", name=name).fill("0.9")
    page.settle()
    button(page, "Add key").click()
    button(page, "Onion skin").click()
    button(page, "Compare").click()
    page.settle()
    seen = "snapspace.stage.root.children.filter(({ visible }) => visible)"
    blend, straight, ghost = page.run(
        f"{seen}.map(({{ matrix }}) => [...matrix.elements.slice(12, 15)])"
    )
    assert ghost == blend != straight
