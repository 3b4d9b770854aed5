"""Work of a page's main thread per picture, in wall time and processor time, from a trace.

The page's own work is what the thread does for it from one picture to the next: event handlers,
timers, animation frames, style, layout, hit tests and garbage collection, without the call that
draws the picture. Three figures are separate: the work of the tester's listeners and callbacks,
which users do not have; the browser's painting; and all work of the thread, including the browser's
housekeeping and the tester's commands. Processor time counts only this thread. Where software
rendering keeps all cores busy, the thread often has to wait, which adds only to wall time.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any, NamedTuple

CATEGORIES = ["devtools.timeline", "toplevel"]
COUNTED = {
    "EventDispatch",
    "TimerFire",
    "FireAnimationFrame",
    "FireIdleCallback",
    "RunMicrotasks",
    "UpdateLayoutTree",
    "Layout",
    "HitTest",
    "MinorGC",
    "MajorGC",
}
PAINTING = {"PrePaint", "Paint", "Layerize"}
TASK = "ThreadControllerImpl::RunTask"
# A separate event: the trace has its times. Marks would take longer than what they measure.
MARK_DRAWING = """() => {
  const { stage } = snapspace, { renderer } = stage, drawing = document.createElement("i");
  const render = renderer.render.bind(renderer);
  drawing.addEventListener("draw", () => render(stage.scene, stage.camera));
  renderer.render = (scene, camera) =>
    scene === stage.scene ? drawing.dispatchEvent(new Event("draw")) : render(scene, camera);
}"""
Event = dict[str, Any]


class Work(NamedTuple):
    """Milliseconds of wall time and of processor time."""

    wall: float
    cpu: float


class Picture(NamedTuple):
    """Work from the previous picture to this one, without the calls that draw them."""

    own: Work
    tester: Work
    painting: Work
    thread: Work


class MainThread:
    """Traces a page that shows a model, from construction until `pictures` is called."""

    def __init__(self, page: Any) -> None:
        self._page = page
        self._events: list[Event] = []
        self._is_complete = False
        page.evaluate(MARK_DRAWING)
        self._devtools = page.context.new_cdp_session(page)
        self._devtools.on("Tracing.dataCollected", lambda part: self._events.extend(part["value"]))
        self._devtools.on("Tracing.tracingComplete", self._complete)
        config = {"includedCategories": CATEGORIES}
        self._devtools.send(
            "Tracing.start", {"traceConfig": config, "transferMode": "ReportEvents"}
        )

    def pictures(self) -> list[Picture]:
        """Ends the trace, and returns the work for each picture."""
        self._devtools.send("Tracing.end")
        while not self._is_complete:
            self._page.wait_for_timeout(20)
        address = self._page.url.partition("#")[0]  # the pose is no part of a script's address
        return per_picture(self._events, address)

    def _complete(self, _: Any) -> None:
        self._is_complete = True


def per_picture(events: list[Event], address: str) -> list[Picture]:
    """Work of the drawing thread; functions from `address` are the page's, others the tester's."""
    events = [event for event in events if event["ph"] == "X" and "tdur" in event]
    drawings = sorted(filter(_is_drawing, events), key=lambda event: event["ts"])
    events = [event for event in events if event["tid"] == drawings[0]["tid"]]
    calls = [event for event in events if event["name"] == "FunctionCall"]

    def is_testers(part: Event) -> bool:
        inner = [call for call in calls if 0 <= call["ts"] - part["ts"] < part["dur"]]
        if not inner:  # a promise resolved by an animation frame calls no function
            return part["name"] == "FireAnimationFrame"
        return all(call["args"]["data"].get("url") != address for call in inner)

    parts = _outermost(event for event in events if event["name"] in COUNTED)
    testers = {id(part) for part in filter(is_testers, parts)}
    between = _Between(drawings)
    return [
        Picture(*works)
        for works in zip(
            between.works(part for part in parts if id(part) not in testers),
            between.works((part for part in parts if id(part) in testers), draws=False),
            between.works((e for e in events if e["name"] in PAINTING), draws=False),
            between.works(_outermost(event for event in events if event["name"] == TASK)),
            strict=True,
        )
    ]


class _Between:
    """Sums of the work that began between two pictures."""

    def __init__(self, drawings: list[Event]) -> None:
        self._pairs = list(pairwise(drawings))

    def works(self, parts: Iterable[Event], *, draws: bool = True) -> list[Work]:
        """Work for each picture except the first; `draws` if one of the parts contains drawing."""
        parts = list(parts)
        return [self._work(parts, *pair, draws) for pair in self._pairs]

    @staticmethod
    def _work(parts: list[Event], before: Event, drawing: Event, draws: bool) -> Work:
        own = [part for part in parts if before["ts"] < part["ts"] < drawing["ts"]]
        wall, cpu = (
            sum(part[key] for part in own) - draws * drawing[key] for key in ("dur", "tdur")
        )
        return Work(wall / 1e3, cpu / 1e3)


def _is_drawing(event: Event) -> bool:
    data = event["args"].get("data", {})
    return event["name"] == "EventDispatch" and data.get("type") == "draw"


def _outermost(events: Iterable[Event]) -> list[Event]:
    """The events that no other event contains, in order of time."""
    found: list[Event] = []
    for event in sorted(events, key=lambda event: (event["ts"], -event["dur"])):
        if not found or event["ts"] >= found[-1]["ts"] + found[-1]["dur"]:
            found.append(event)
    return found
