"""An open page, as a user and as a script sees it."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]
OpenPage = Callable[..., "Page"]
SECONDS = 60.0  # software rendering on a busy machine is slow


class Page:
    """A page, and what went wrong in it: console errors, exceptions, requests to other places."""

    def __init__(self, page: Any, address: str) -> None:
        self.page, self.address = page, address
        self.faults: list[str] = []
        self.loses_server = False  # true in tests that end it: what Chromium says then is no fault
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.faults.append(f"exception: {error}"))
        page.on("request", self._request)

    def _console(self, message: Any) -> None:
        told = message.text
        is_lost = self.loses_server and told.startswith(("WebSocket connection", "Failed to load"))
        if message.type in ("error", "warning") and "GPU stall" not in told and not is_lost:
            self.faults.append(f"console: {told}")

    def _request(self, request: Any) -> None:
        own = self.address.split("?")[0].rsplit("/", 1)[0]
        if not request.url.startswith((own, "data:", "blob:")):
            self.faults.append(f"request: {request.url}")

    def open(self) -> None:
        self.page.goto(self.address)
        self.wait("Boolean(snapspace.ready || snapspace.message)")

    def run(self, script: str, argument: Any = None) -> Any:
        return self.page.evaluate(script, argument)

    def wait(self, condition: str) -> None:
        """Until an expression is true; Playwright's own way is forbidden by the page's policy."""
        end = time.monotonic() + SECONDS
        while not self.run(condition):
            assert time.monotonic() < end, f"still not: {condition}"
            self.page.wait_for_timeout(20)

    def settle(self) -> None:
        """Waits until what was asked for is drawn."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def shown(self, name: str = "shown") -> NDArray[np.float64]:
        """The vertices as the vertex shader gets them, (s, 3)."""
        self.settle()
        return np.array(self.run(f"[...snapspace.{name}()]")).reshape(-1, 3)

    def drag(self, start: Point, dx: float, dy: float, *, shift: bool = False) -> None:
        """Presses, moves in steps and lets go, with the pointer."""
        mouse, keyboard = self.page.mouse, self.page.keyboard
        mouse.move(*start)
        if shift:
            keyboard.down("Shift")
        mouse.down()
        for step in range(1, 6):
            mouse.move(start[0] + dx * step / 5, start[1] + dy * step / 5)
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
        self.page.close()


def open_page(browser: Any, address: str, **options: Any) -> Page:
    """A page of its own, 800 x 480 unless `options` say otherwise."""
    size = options.pop("size", (800, 480))
    viewport = {"width": size[0], "height": size[1]}
    page = Page(browser.new_page(viewport=viewport, **options), address)
    page.open()
    return page
