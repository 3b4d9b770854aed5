"""A page in a frame of another page, as in notebooks."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from ..page_numbers import numbers
from .pages import SECONDS

STATE = "window.snapspace ? snapspace.message || (snapspace.ready ? 'ready' : '') : ''"


def ready(frame: Any) -> Any:
    """The frame, once its model is shown."""
    end = time.monotonic() + SECONDS
    while not (state := frame.evaluate(STATE)):
        assert time.monotonic() < end, "the page in the frame is not ready"
        frame.page.wait_for_timeout(50)
    assert state == "ready"
    return frame


def dragged(page: Any, frame: Any, handle: int, dx: float, dy: float) -> float:
    """Drags a handle with the pointer and returns the largest motion of a vertex."""
    element = frame.frame_element()
    element.scroll_into_view_if_needed()
    page.wait_for_timeout(200)  # notebooks scroll a little further
    box = element.bounding_box()
    x, y = frame.evaluate(f"snapspace.handle({handle})")
    x, y = x + box["x"], y + box["y"]
    before = numbers(frame, "snapspace.shown()")
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 6):
        page.mouse.move(x + dx * step / 5, y + dy * step / 5)
        page.wait_for_timeout(50)
    page.mouse.up()
    page.wait_for_timeout(300)
    return float(np.abs(numbers(frame, "snapspace.shown()") - before).max())
