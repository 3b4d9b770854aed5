"""The page on which handles are chosen, as its user sees it."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from snapspace.generators import bar

from .pages import PAUSE, SECONDS, OpenPage, Page, Point

#: Most tests choose handles on it.
BAR = bar(12, 3, 3, length=4.0, width=1.0, height=1.0)
ENDS = {"foot": BAR.vertices[:, 0] < 0.7, "head": BAR.vertices[:, 0] > 3.3}
TAKE_HANDLES = """(given) => snapspace.choosing.go({
  ...snapspace.choosing.choice, selected: Int32Array.of(), parts: [],
  handles: given.map(([name, vertices], key) => ({
    key, name, vertices: Int32Array.from(vertices), moving: key > 0, translation: null, angle: null,
  })),
})"""


def places(page: Page) -> NDArray[np.float64]:
    """Where the vertices are in the window, (n, 2)."""
    script = "[...Array(snapspace.choosing.mesh.shape.length / 3).keys()].flatMap(snapspace.screen)"
    return page.numbers(script).reshape(-1, 2)


def selected(page: Page) -> set[int]:
    return set(page.run("snapspace.selected"))


def handles(page: Page) -> dict[str, set[int]]:
    found = page.run("snapspace.handles")
    return {handle["name"]: set(handle["vertices"]) for handle in found}


def stroke(page: Page, *points: Point, key: str | None = None, button: str = "left") -> None:
    """Presses at the first point, moves along the others and releases."""
    mouse, keyboard = page.page.mouse, page.page.keyboard
    if key:
        keyboard.down(key)
    mouse.move(*points[0])
    mouse.down(button=button)
    for point in points[1:]:
        mouse.move(*point, steps=5)
    mouse.up(button=button)
    if key:
        keyboard.up(key)
    page.settle()


def tool(page: Page, name: str) -> None:
    page.page.get_by_role("radio", name=name, exact=True).click()


def cancel(page: Page) -> None:
    """Presses Cancel at once: Playwright's own click waits for pictures, and computations end."""
    page.page.get_by_role("button", name="Cancel", exact=True).dispatch_event("click")


def press(page: Page, name: str) -> None:
    page.page.get_by_role("button", name=name, exact=True).click()


def make_handle(page: Page, name: str) -> None:
    """The selection becomes a handle, and its name is typed at once."""
    press_new = page.page.get_by_role("button", name="New handle")
    press_new.first.click()
    page.page.keyboard.type(name)
    page.page.keyboard.press("Enter")


def ends_as_handles(page: Page) -> None:
    """The ends of a bar along x become the handles foot and head, by box and lasso."""
    x, y = places(page).T
    left, right, top, bottom = x.min(), x.max(), y.min(), y.max()
    quarter = 0.2 * (right - left)
    tool(page, "Box")
    stroke(page, (left - 5, top - 5), (left + quarter, bottom + 5))
    make_handle(page, "foot")
    tool(page, "Lasso")
    edge = right - quarter
    corners = [(edge, top - 5), (right + 5, top - 5), (right + 5, bottom + 5), (edge, bottom + 5)]
    stroke(page, *corners)
    make_handle(page, "head")


def bar_with_ends(opened: OpenPage, address: str) -> Page:
    """The page of a server that has `BAR`, with the handles foot and head, without any stroke."""
    page: Page = opened(address)
    page.wait("snapspace.kind === 'choosing'")
    take_ends(page)
    return page


def take_ends(page: Page) -> None:
    """The handles of `BAR` become foot and head; nothing is selected, and there are no parts."""
    ends = [[name, np.flatnonzero(end).tolist()] for name, end in ENDS.items()]
    page.run(TAKE_HANDLES, ends)


def saved_file(page: Page) -> str:
    """The name of the problem file that the page has just saved."""
    return page.text("#panel .saved").split()[1].rstrip(",")


def set_number(page: Page, label: str, value: float) -> None:
    """Types a number among motions and accuracy."""
    field = page.page.get_by_label(label)
    if not field.is_visible():
        page.page.locator("summary").click()
    field.fill(str(value))


def compute(page: Page, most_samples: int = 20, percent: float = 50.0) -> None:
    """Begins to compute; with these defaults, one model is good enough."""
    set_number(page, "Error of unseen motions, %", percent)
    set_number(page, "Samples, at most", most_samples)
    press(page, "Compute")


def wait_for_last_model(page: Page) -> None:
    """Waits until nothing is computed: what a model brings moves the buttons below it."""
    page.page.get_by_role("button", name="Cancel", exact=True).wait_for(state="hidden")


def wait_for_text(page: Page, selector: str, text: str) -> None:
    end = time.monotonic() + SECONDS
    while text not in (found := page.text(selector)):
        assert time.monotonic() < end, f"no '{text}' in: {found}"
        page.page.wait_for_timeout(PAUSE)


def widen(page: Page, degrees: float = 120.0) -> None:
    """Lets handles turn far, so that a computation takes long: tests stop it in the middle."""
    press(page, "Range")
    page.page.get_by_label("Turn, plus or minus").first.fill(str(degrees))
