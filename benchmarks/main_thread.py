"""Work of a page's main thread per picture, by wall clock and by processor time, out of a trace.

Counted is what the thread does for the page from one picture to the next: event handlers, timers,
animation frames, style, layout and garbage collection, apart from the call that draws the picture
and from the browser's painting. Processor time is the thread's own: where software rendering keeps
all cores busy the thread is often put aside, and only wall time grows by that.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

CATEGORIES = ["devtools.timeline"]
COUNTED = {
    "EventDispatch",
    "TimerFire",
    "FireAnimationFrame",
    "RunMicrotasks",
    "UpdateLayoutTree",
    "Layout",
    "MinorGC",
    "MajorGC",
}
# An event of its own: the trace has its times, and marks would take longer than what they measure.
TELL_DRAWING = """() => {
  const { stage } = snapspace, { renderer } = stage, drawing = document.createElement("i");
  const render = renderer.render.bind(renderer);
  drawing.addEventListener("draw", () => render(stage.scene, stage.camera));
  renderer.render = (scene, camera) =>
    scene === stage.scene ? drawing.dispatchEvent(new Event("draw")) : render(scene, camera);
}"""
Work = tuple[float, float]


class MainThread:
    """Traces a page that shows a model, from its making to `works`."""

    def __init__(self, page: Any) -> None:
        self._page = page
        self._events: list[dict[str, Any]] = []
        self._is_complete = False
        page.evaluate(TELL_DRAWING)
        self._devtools = page.context.new_cdp_session(page)
        self._devtools.on("Tracing.dataCollected", lambda part: self._events.extend(part["value"]))
        self._devtools.on("Tracing.tracingComplete", self._complete)
        config = {"includedCategories": CATEGORIES}
        self._devtools.send(
            "Tracing.start", {"traceConfig": config, "transferMode": "ReportEvents"}
        )

    def works(self) -> list[Work]:
        """Ends the trace. Milliseconds by the wall clock and of the processor, by picture."""
        self._devtools.send("Tracing.end")
        while not self._is_complete:
            self._page.wait_for_timeout(20)
        return per_picture(self._events)

    def _complete(self, _: Any) -> None:
        self._is_complete = True


def per_picture(events: list[dict[str, Any]]) -> list[Work]:
    """Wall and processor time from one picture to the next, of the thread that draws them."""
    events = [event for event in events if event["ph"] == "X" and "tdur" in event]
    drawings = sorted(filter(_is_drawing, events), key=lambda event: event["ts"])
    thread = drawings[0]["tid"]
    parts = _outermost(e for e in events if e["tid"] == thread and e["name"] in COUNTED)
    works = []
    for before, drawing in pairwise(drawings):
        own = [part for part in parts if before["ts"] < part["ts"] < drawing["ts"]]
        wall, cpu = (sum(part[key] for part in own) - drawing[key] for key in ("dur", "tdur"))
        works.append((wall / 1e3, cpu / 1e3))
    return works


def _is_drawing(event: dict[str, Any]) -> bool:
    data = event["args"].get("data", {})
    return event["name"] == "EventDispatch" and data.get("type") == "draw"


def _outermost(events: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those that are in no other one, by time."""
    found: list[dict[str, Any]] = []
    for event in sorted(events, key=lambda event: (event["ts"], -event["dur"])):
        if not found or event["ts"] >= found[-1]["ts"] + found[-1]["dur"]:
            found.append(event)
    return found
