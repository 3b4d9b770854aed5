"""Tools that select, and the list of handles, in a browser with the real server."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from snapspace.mesh import TetMesh

from .choosing_page import (
    BAR,
    ends_as_handles,
    handles,
    make_handle,
    places,
    press,
    selected,
    stroke,
    take_ends,
    tool,
)
from .pages import OpenPage, Page, Tabs


@pytest.fixture(scope="module")
def kept(bar_server: str, tabs: Tabs) -> Iterator[Page]:
    page = tabs.open(bar_server)
    page.wait("Boolean(snapspace.ready)")  # at first it says that the mesh is being read
    assert page.run("snapspace.kind") == "choosing"
    yield page
    tabs.close(page)


#: The first state, except that earlier steps can be undone.
NOTHING_CHOSEN = """(() => {
  const { choosing } = snapspace;
  document.activeElement.blur();
  Object.assign(choosing, { tool: "brush", removing: false, seenOnly: false, radius: 0.05 });
  choosing.go({ selected: Int32Array.of(), handles: [], parts: [] });
  document.getElementById("frame").click();
  const { left, top, width, height } = document.querySelector("canvas").getBoundingClientRect();
  return [left + width / 2, top + height / 2];
})()"""


#: Ends of the axes that the floating button covers.
OVERLAPPING = """(() => {
  const button = document.querySelector("button.floating").getBoundingClientRect();
  return [...document.querySelectorAll(".axis-widget circle")].filter((end) => {
    const { right, bottom } = end.getBoundingClientRect();
    return right > button.left && bottom > button.top;
  }).map((end) => end.parentElement.getAttribute("aria-label"));
})()"""


@pytest.fixture
def page(kept: Page) -> Page:
    """The page with nothing chosen, and the pointer in the middle; the tests share it."""
    kept.page.mouse.move(*kept.run(NOTHING_CHOSEN))
    kept.settle()
    return kept


def within(page: Page, low: tuple[float, float], high: tuple[float, float]) -> set[int]:
    inside = ((places(page) >= low) & (places(page) <= high)).all(axis=1)
    return set(np.flatnonzero(inside).tolist())


def surface_of(mesh: TetMesh) -> set[int]:
    return set(mesh.surface_vertices.tolist())


def test_box_and_lasso_take_the_vertices_in_them(page: Page) -> None:
    x, y = places(page).mean(axis=0)
    low, high = (x - 70, y - 60), (x + 10, y + 60)
    expected = within(page, low, high)
    assert 0 < len(expected) < len(BAR.vertices) and not expected <= surface_of(BAR)
    tool(page, "Box")
    stroke(page, high, low)
    assert selected(page) == expected
    stroke(page, low, (low[0] + 30, high[1]), key="Alt")
    assert selected(page) == within(page, (low[0] + 30.001, low[1]), high)
    press(page, "Clear")
    assert not selected(page)
    tool(page, "Lasso")
    stroke(page, low, (high[0], low[1]), high, (low[0], high[1]))
    assert selected(page) == expected
    for key, count in (("z", 0), ("Shift+Z", len(expected))):
        page.page.keyboard.press(f"Control+{key}")
        assert len(selected(page)) == count


def test_seen_only_takes_visible_vertices(page: Page) -> None:
    tool(page, "Box")
    tool(page, "Seen only")
    stroke(page, (3, 3), (500, 470))
    seen = selected(page)
    # the camera looks from +x, -y (the page's front) and +z: these sides of the bar are seen
    x, y, z = BAR.vertices.T
    front = (x == x.max()) | (y == y.min()) | (z == z.max())
    assert seen == set(np.flatnonzero(front).tolist())
    assert seen < surface_of(BAR)


def test_the_brush_paints_a_ball_also_inside(page: Page) -> None:
    x, y = places(page)[np.argmin(((BAR.vertices - (2.0, -0.5, 0.5)) ** 2).sum(axis=1))]
    stroke(page, (x, y))
    center = page.run("([x, y]) => snapspace.choosing.hit([x, y])", [x, y])
    away = np.linalg.norm(BAR.vertices - center, axis=1)
    assert selected(page) == set(np.flatnonzero(away <= 0.05 * BAR.diagonal).tolist())
    for _ in range(8):
        page.page.keyboard.press("]")
    stroke(page, (x, y), (x + 60, y + 8))
    painted = selected(page)
    assert not painted <= surface_of(BAR)
    stroke(page, (x + 60, y + 8), key="Alt")
    assert selected(page) < painted
    assert page.run("document.querySelector('.ring').style.display") != "none"


def test_keys_paint_without_a_pointer(page: Page) -> None:
    page.page.locator("canvas").focus()
    for key in ("ArrowUp", "ArrowLeft", " ", "ArrowRight", " "):
        page.page.keyboard.press(key)
    assert selected(page)
    page.page.keyboard.press("Enter")
    assert list(handles(page)) == ["handle 1"]
    page.page.keyboard.press("Escape")
    page.page.keyboard.press("x")
    assert page.run("snapspace.choosing.tool") == "box"


def test_a_drop_down_keeps_its_keys(page: Page) -> None:
    page.page.locator("canvas").focus()
    page.page.keyboard.press(" ")
    assert selected(page)
    material = page.page.get_by_label("Material", exact=True)
    material.focus()
    before = material.input_value()
    for key in ("x", "Enter", "Escape"):
        page.page.keyboard.press(key)
    assert not handles(page), "Enter opens the list"
    assert page.run("snapspace.choosing.tool") == "brush" and material.input_value() == before
    assert "brush" in page.page.locator("canvas").get_attribute("aria-label")


def test_compute_unfolds_the_range_that_is_wrong(page: Page) -> None:
    take_ends(page)
    travel = page.page.get_by_label("Travel, plus or minus").first
    press(page, "Range")
    travel.fill("")
    press(page, "Range")
    assert not travel.is_visible()
    press(page, "Compute")
    assert travel.is_visible() and travel.evaluate("(e) => e === document.activeElement")
    travel.fill("10")
    press(page, "Range")


def test_the_right_button_and_a_drag_beside_the_body_look_around(page: Page) -> None:
    camera = "snapspace.stage.camera.position.toArray()"
    before = page.run(camera)
    tool(page, "Box")
    stroke(page, (200, 200), (260, 220), button="right")
    after = page.run(camera)
    assert after != before and not selected(page)
    tool(page, "Brush")
    stroke(page, (20, 460), (80, 450))
    assert page.run(camera) != after and not selected(page)


def test_a_vertex_belongs_to_one_handle(page: Page) -> None:
    ends_as_handles(page)
    before = handles(page)
    assert set(before) == {"foot", "head"}
    assert (
        page.run("[...document.querySelectorAll('.handles button')].map((b) => b.ariaPressed)")[1]
        == "true"
    ), "the first one is fixed"
    tool(page, "Box")
    stroke(page, (3, 3), (500, 470))
    make_handle(page, "all")
    assert set(handles(page)) == {"all"} and len(handles(page)["all"]) == len(BAR.vertices)
    press(page, "Undo")
    press(page, "Undo")
    assert handles(page) == before
    name = page.page.get_by_label("Name of the handle").first
    name.fill("head")
    name.press("Enter")
    assert "There is already a handle named head." in page.text("#panel")
    assert handles(page) == before
    press(page, "Delete head")
    assert "part to move" in page.text("#panel")
    assert page.page.get_by_role("button", name="Compute").is_disabled()


def test_one_finger_paints_and_two_look_around(bar_server: str, opened: OpenPage) -> None:
    page = opened(bar_server, size=(390, 844), has_touch=True, is_mobile=True, color_scheme="dark")
    page.wait("Boolean(snapspace.ready)")
    touch = page.page.context.new_cdp_session(page.page)

    def send(kind: str, *points: tuple[float, float]) -> None:
        touches = [{"x": px, "y": py, "id": i} for i, (px, py) in enumerate(points)]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})
        page.settle()

    x, y = places(page).mean(axis=0)
    send("touchStart", (x, y))
    send("touchMove", (x + 10, y))
    send("touchEnd")
    painted = selected(page)
    assert painted
    camera = "snapspace.stage.camera.position.toArray()"
    before = page.run(camera)
    send("touchStart", (x + 30, y))
    send("touchStart", (x + 30, y), (x + 80, y))
    for step in range(1, 5):
        send("touchMove", (x + 30 + 8 * step, y), (x + 80 + 8 * step, y))
    send("touchEnd")
    assert page.run(camera) != before
    assert selected(page) == painted, "the stroke of the first finger is forgotten"
    page.run("document.querySelector('button.floating').textContent += ', and 10,000 more'")
    assert page.run(OVERLAPPING) == [], "the button is beside the axes"
    page.page.locator("button.floating").tap()
    assert handles(page) == {"handle 1": painted}
    assert page.run("document.documentElement.dataset.theme") == "dark"
    assert page.run("document.querySelector('#panel').scrollWidth") == 390
