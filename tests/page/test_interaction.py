"""Cancelled drags, keys in the middle of one, colours of axes, and graphics that are lost."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from snapspace import PosingModel

from .choosing_page import handles, places, press, selected, stroke, tool
from .pages import OpenPage, Page
from .test_posing_page import assert_shown

AXES = {"x": "#e8402f", "y": "#3fae3a", "z": "#2f74e8"}

UNDO, REDO = (
    f"[...document.querySelectorAll('button')].find((b) => b.textContent === '{name}')"
    for name in ("Undo", "Redo")
)


def begin_drag(page: Page, dx: float, dy: float) -> None:
    x, y = page.run("snapspace.handle(1)")
    mouse = page.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + dx, y + dy, steps=3)
    page.settle()


def key(page: Page, *names: str) -> None:
    for name in names:
        page.page.keyboard.press(name)
    page.settle()


def shift_of(page: Page) -> np.ndarray:
    return np.array(page.motions()[1][1])


def test_a_drag_is_cancelled_and_undo_waits_for_its_end(
    posing_model: PosingModel, posing: Page
) -> None:
    page = posing
    page.drag(page.run("snapspace.handle(1)"), 30, -20)
    first = shift_of(page)
    begin_drag(page, 40, 30)
    dragged = shift_of(page)
    assert np.linalg.norm(dragged - first) > 0.02
    key(page, "Control+z", "r", "ArrowUp")
    assert np.array_equal(shift_of(page), dragged), "no key counts in a drag"
    page.run(f"{UNDO}.click()")  # with another finger
    assert np.array_equal(shift_of(page), dragged)
    key(page, "Escape")
    assert np.allclose(shift_of(page), first)
    page.page.mouse.move(300, 300)
    page.settle()
    assert np.allclose(shift_of(page), first), "the drag is over, although the pointer moves"
    page.page.mouse.up()
    assert page.run(f"{REDO}.disabled"), "nothing to redo"
    page.drag(page.run("snapspace.handle(1)"), -30, 20)
    second = shift_of(page)
    key(page, "Control+z")
    assert np.allclose(shift_of(page), first), "the cancelled drag is no step"
    key(page, "Control+y")
    assert np.allclose(shift_of(page), second)
    assert_shown(posing_model, page)

    arrows = dict(zip("xyz", np.array(arrow_directions(page)), strict=True))
    assert np.allclose(np.abs(arrows["z"]), [0, 1, 0]), "up, where z points up"
    for axis in "yx":
        tool(page, f"{axis} up")
        page.settle()
        arrows = dict(zip("xyz", np.array(arrow_directions(page)), strict=True))
        assert np.allclose(np.abs(arrows[axis]), [0, 1, 0])
        for name, place in zip("xyz", range(3), strict=True):
            script = (
                f"snapspace.stage.root.matrixWorld.elements.slice({4 * place}, {4 * place + 3})"
            )
            along = np.array(page.run(script))
            assert np.isclose(abs(along @ arrows[name]), np.linalg.norm(along)), name


def arrow_directions(page: Page) -> list[list[float]]:
    """Directions on the stage of the arrows in the colours of the model's x, y and z."""
    arrows = page.run("snapspace.arrows()")
    return [next(a["direction"] for a in arrows if a["color"] == AXES[axis]) for axis in "xyz"]


def test_a_drag_of_the_gizmo_is_cancelled(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    key(page, "2")
    x, y = page.run("snapspace.handle(1)")
    mouse = page.page.mouse
    # along the arrow that points up on the screen
    top = next(up for up in range(20, 80, 4) if is_on_arrow(page, x, y - up))
    mouse.move(x, y - top)
    mouse.down()
    mouse.move(x, y - top - 40, steps=3)
    page.settle()
    assert np.linalg.norm(shift_of(page)) > 0.02
    key(page, "Escape")
    assert np.allclose(shift_of(page), 0)
    mouse.move(x, y - top - 80, steps=3)
    mouse.up()
    page.settle()
    assert np.allclose(shift_of(page), 0)
    assert page.run(f"{UNDO}.disabled"), "nothing to undo"


def is_on_arrow(page: Page, x: float, y: float) -> bool:
    page.page.mouse.move(x, y)
    page.settle()
    return any(arrow["color"] == "#ffd23f" for arrow in page.run("snapspace.arrows()"))


LOSE = "window.losing = snapspace.stage.renderer.gl.getExtension('WEBGL_lose_context')"
PIXELS = """(() => {
  const { renderer, scene, camera } = snapspace.stage;
  renderer.render(scene, camera);
  const gl = renderer.gl, size = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const pixels = new Uint8Array(4 * size[0] * size[1]);
  gl.readPixels(0, 0, ...size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels.filter((_, i) => i % 16 === 3);
})()"""


def lose(page: Page) -> None:
    page.run(f"{LOSE}; losing.loseContext(); null")
    page.wait("snapspace.stage.renderer.gl.isContextLost()")


def give_back(page: Page) -> None:
    page.run("losing.restoreContext(); null")
    page.wait("!snapspace.stage.renderer.gl.isContextLost()")
    page.settle()


def test_lost_graphics_are_drawn_again(
    posing_model: PosingModel, posing_page: Path, opened: OpenPage
) -> None:
    page = opened(posing_page.as_uri(), sharp=True)
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    before = page.numbers(PIXELS)
    lose(page)
    key(page, "ArrowUp")  # a solve while nothing can be drawn
    key(page, "Control+z")
    give_back(page)
    assert_shown(posing_model, page)
    after = page.numbers(PIXELS)
    assert np.count_nonzero(before) > 100
    assert np.mean(np.abs(after - before) > 40) < 0.01, "the same picture"


def test_ghosts_come_back_with_the_graphics_and_exports_wait(
    posing_page: Path, opened: OpenPage
) -> None:
    page = opened(posing_page.as_uri(), sharp=True)
    lose(page)
    page.page.get_by_role("button", name="OBJ", exact=True).click()
    assert "no graphics" in page.text("#panel"), "not a file of zeros"
    key(page, "k")  # a key without a picture
    give_back(page)
    page.drag(page.run("snapspace.handle(1)"), 60, -50)
    key(page, "k")
    assert page.run("snapspace.timeline.timeline.keys.length") == 2
    page.page.get_by_role("button", name="Onion skin").click()
    page.settle()
    before = page.numbers(PIXELS)
    lose(page)
    give_back(page)
    after = page.numbers(PIXELS)
    assert np.mean(np.abs(after - before) > 20) < 0.005, "the same picture, with the ghosts"


def test_undo_waits_for_the_end_of_a_stroke(bar_server: str, opened: OpenPage) -> None:
    page = opened(bar_server)
    page.wait("snapspace.kind === 'choosing'")
    x, y = places(page).mean(axis=0)
    stroke(page, (x, y), (x + 40, y))
    painted = selected(page)
    mouse = page.page.mouse
    mouse.move(x - 60, y)
    mouse.down()
    mouse.move(x - 40, y, steps=2)
    more = selected(page)
    assert painted < more
    key(page, "Control+z", "Enter", "b")
    assert selected(page) == more and not handles(page)
    key(page, "Escape")
    assert selected(page) == painted
    mouse.up()
    key(page, "Control+z")
    assert not selected(page)
    key(page, "Control+y")
    assert selected(page) == painted
    press(page, "Clear")
