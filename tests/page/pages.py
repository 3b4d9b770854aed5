"""An open page, as a user and as a script sees it."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..browser import COARSE
from ..page_numbers import numbers

Point = tuple[float, float]
OpenPage = Callable[..., "Page"]
SECONDS = 60.0  # software rendering on a busy machine is slow
BLANK = "about:blank"
#: Pixels of the picture per pixel of the page: software draws a quarter of them, places stay.
SCALE = 0.5
PAUSE = 40  # milliseconds between two looks


class Page:
    """A page and its faults: console errors, exceptions, requests to other places."""

    def __init__(self, page: Any, address: str) -> None:
        self.page, self.address = page, address
        self.faults: list[str] = []
        self.is_open = True
        self.loses_server = False  # true in tests that end it: its errors are no faults then
        self._listeners = {
            "console": self._console,
            "pageerror": self._exception,
            "request": self._request,
        }
        for event, listener in self._listeners.items():
            page.on(event, listener)

    def forget(self) -> None:
        """Another page in the same tab is no longer this one's."""
        for event, listener in self._listeners.items():
            self.page.remove_listener(event, listener)

    def _exception(self, error: Any) -> None:
        self.faults.append(f"exception: {error}")

    def _console(self, message: Any) -> None:
        text = message.text
        url = message.location.get("url", "")
        is_lost = self.loses_server and text.startswith(("WebSocket connection", "Failed to load"))
        # The server keeps two models. A slow page gets no more than that and reads the newest one.
        is_replaced = "status of 404" in text and "/model/" in url
        if message.type in ("error", "warning") and not (
            "GPU stall" in text or is_lost or is_replaced
        ):
            self.faults.append(f"console: {text} {url}".rstrip())

    def _request(self, request: Any) -> None:
        own = self.address.split("?")[0].rsplit("/", 1)[0]
        if not request.url.startswith((own, "data:", "blob:", BLANK)):
            self.faults.append(f"request: {request.url}")

    def open(self) -> None:
        self.page.goto(self.address)
        self.wait("Boolean(snapspace.ready || snapspace.message)")

    def run(self, script: str, argument: Any = None) -> Any:
        return self.page.evaluate(script, argument)

    def numbers(self, expression: str) -> NDArray[np.float64]:
        """The values of an array of numbers."""
        return numbers(self.page, expression)

    def wait(self, condition: str) -> None:
        """Waits until an expression is true. The page forbids what Playwright has for that."""
        self.wait_for(lambda: bool(self.run(condition)), condition)

    def wait_for(self, is_done: Callable[[], bool], what: str) -> None:
        """Waits until something is done; browser events arrive meanwhile."""
        end = time.monotonic() + SECONDS
        while not is_done():
            assert time.monotonic() < end, f"still not: {what}"
            self.page.wait_for_timeout(PAUSE)

    def settle(self) -> None:
        """Waits until everything that was asked for is drawn."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def rest(self) -> None:
        """Waits until the shape no longer changes from picture to picture."""
        end, last = time.monotonic() + SECONDS, self.shown()
        while not np.array_equal(now := self.shown(), last):
            assert time.monotonic() < end, "the shape still changes"
            last = now

    def shown(self, name: str = "shown") -> NDArray[np.float64]:
        """The vertices that the vertex shader gets, (s, 3)."""
        self.settle()
        return self.numbers(f"snapspace.{name}()").reshape(-1, 3)

    def drag(self, start: Point, dx: float, dy: float, *, shift: bool = False) -> None:
        """Drags with the pointer, in steps."""
        mouse, keyboard = self.page.mouse, self.page.keyboard
        mouse.move(*start)
        if shift:
            keyboard.down("Shift")
        mouse.down()
        for step in range(1, 4):
            mouse.move(start[0] + dx * step / 3, start[1] + dy * step / 3)
            self.settle()
        mouse.up()
        if shift:
            keyboard.up("Shift")
        self.settle()

    def motions(self) -> dict[int, tuple[list[float], list[float]]]:
        """Euler angles and translations of all handles."""
        pairs = self.run(
            "snapspace.session.model.handles.map((_, h) => "
            "[snapspace.session.euler(h), snapspace.session.motion(h).translation])"
        )
        return {handle: (euler, shift) for handle, (euler, shift) in enumerate(pairs)}

    def text(self, selector: str) -> str:
        text: str = self.page.inner_text(selector)
        return text

    def close(self) -> None:
        """Leaves the page; its tab can show another one."""
        if self.is_open:
            self.page.mouse.up()
            self.page.goto(BLANK)
        self.is_open = False


class Tabs:
    """Opens pages in tabs that are used again: a new tab costs more than a page in it."""

    def __init__(self, browser: Any) -> None:
        self._browser = browser
        self._free: dict[str, list[Any]] = {}  # by the options of their contexts
        self._options: dict[Page, str] = {}

    def open(
        self,
        address: str,
        *,
        size: tuple[int, int] = (800, 480),
        sharp: bool = False,
        **options: Any,
    ) -> Page:
        """A page of `size`; other options are those of Playwright's contexts.

        Pixels of canvases can be looked at if it is `sharp`. Nothing in it moves by itself, such
        as a progress bar: that would take half of a processor.
        """
        viewport = {"width": size[0], "height": size[1]}
        options = {"device_scale_factor": SCALE, "reduced_motion": "reduce", **options}
        key = repr((sharp, sorted(options.items())))
        free = self._free.setdefault(key, [])
        if free:
            tab = free.pop()
            tab.set_viewport_size(viewport)
        else:
            tab = self._browser.new_page(viewport=viewport, **options)
            if not sharp:
                tab.add_init_script(COARSE)
        page = Page(tab, address)
        self._options[page] = key
        page.open()
        return page

    def close(self, page: Page) -> None:
        """Leaves a page, which must have met no errors and made no requests to other places."""
        page.close()
        page.forget()
        self._free[self._options.pop(page)].append(page.page)
        assert page.faults == [], page.faults
