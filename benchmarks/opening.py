"""A large surface opens in the page: seconds to its picture and to its tets, and the longest task.

    python benchmarks/opening.py                     # a generated body of 370k faces
    python benchmarks/opening.py scan.ply --edge-length 0.05
    python benchmarks/opening.py --rings 501         # a million faces

The page is that of `snapspace view` in headless Chromium with software rendering. The surface is
given to the server (view), or dropped on the page (upload). The server's processor time counts from
the request for the page. The main thread's tasks come from a trace that runs from the page's start
to the first ray after there are tets. Each is given in wall time and in processor time: on a busy
machine only the latter says what users get. Software rendering takes seconds for what graphics
processors do in milliseconds; its time is listed separately.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import common
import numpy as np
import psutil
from main_thread import CATEGORIES, TASK
from page import DRAWN, SOFTWARE_WEBGL
from playwright.sync_api import sync_playwright

import snapspace as ss

PATIENCE = 900.0  # seconds
POLL = 100.0  # milliseconds
SHOWN = "['surface', 'choosing'].includes(window.snapspace?.kind)"
CHOOSING = "window.snapspace?.kind === 'choosing'"
EMPTY = "document.querySelector('#message input[type=file]') !== null"


def large_surface(rings: int) -> tuple[np.ndarray, np.ndarray]:
    """A body with bumps of two sizes, 4 rings (rings - 1) faces without those at the poles."""
    polar = np.linspace(0.0, np.pi, rings + 1)[1:-1, None]
    angle = np.linspace(0.0, 2.0 * np.pi, 2 * rings, endpoint=False)
    x, y = np.sin(polar) * np.cos(angle), np.sin(polar) * np.sin(angle)
    rows = np.stack([x, y, np.cos(polar) + 0.0 * angle], axis=-1)
    points = np.concatenate([rows.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    radius = 1.0 + 0.15 * np.sin(5.0 * points[:, 0]) * np.cos(4.0 * points[:, 1])
    radius += 0.02 * np.sin(40.0 * points[:, 2])
    here = np.arange(2 * rings)
    after = np.roll(here, -1)
    row = 2 * rings * np.arange(rings - 2)[:, None]
    a, b, c, d = row + here, row + after, row + 2 * rings + here, row + 2 * rings + after
    top, bottom, last = len(points) - 2, len(points) - 1, 2 * rings * (rings - 2)
    faces = [
        np.stack([a, c, b], axis=-1).reshape(-1, 3),
        np.stack([b, c, d], axis=-1).reshape(-1, 3),
        np.stack([np.full(2 * rings, top), here, after], axis=-1),
        np.stack([np.full(2 * rings, bottom), last + after, last + here], axis=-1),
    ]
    return points * radius[:, None] * [2.0, 1.0, 1.0], np.concatenate(faces).astype(np.int32)


class Server:
    """`snapspace view`, and its processor time."""

    def __init__(self, *words: str) -> None:
        command = [sys.executable, "-m", "snapspace", "view", "--no-browser", *words]
        self._process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        assert self._process.stdout is not None
        lines = self._process.stdout
        self.address = next(word for line in lines for word in line.split() if "://" in word)

    def __enter__(self) -> Server:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.terminate()
        self._process.communicate()

    @property
    def processor(self) -> float:
        """Seconds so far, of all its threads."""
        return processor_seconds(psutil.Process(self._process.pid))


def processor_seconds(process: psutil.Process) -> float:
    """User and system time so far, of all its threads."""
    times = process.cpu_times()
    return float(times.user + times.system)


def drawing() -> float:
    """Processor time so far of the browser's process for graphics, which draws in software."""
    family = psutil.Process().children(recursive=True)
    return sum(processor_seconds(p) for p in family if "--type=gpu-process" in p.cmdline())


class Trace:
    """The tasks of all threads from construction on."""

    def __init__(self, page: Any) -> None:
        self._page, self._events, self._is_complete = page, [], False
        self._devtools = page.context.new_cdp_session(page)
        self._devtools.on("Tracing.dataCollected", lambda part: self._events.extend(part["value"]))
        self._devtools.on("Tracing.tracingComplete", lambda _: setattr(self, "_is_complete", True))
        config = {"includedCategories": CATEGORIES, "recordMode": "recordContinuously"}
        self._devtools.send(
            "Tracing.start", {"traceConfig": config, "transferMode": "ReportEvents"}
        )

    def longest(self) -> tuple[float, float]:
        """Ends the trace; milliseconds of the page's longest task, in wall and processor time.

        They may be those of two tasks.
        """
        self._devtools.send("Tracing.end")
        while not self._is_complete:
            self._page.wait_for_timeout(20)
        events = [e for e in self._events if e["ph"] == "X" and "tdur" in e]
        # the page's thread is the one that runs functions
        threads = [(e["pid"], e["tid"]) for e in events if e["name"] == "FunctionCall"]
        page = max(set(threads), key=threads.count)
        names = {TASK, "BlinkScheduler_PerformMicrotaskCheckpoint", "FunctionCall"}
        own = [e for e in events if (e["pid"], e["tid"]) == page and e["name"] in names]
        wall, processor = (max(event[key] for event in own) for key in ("dur", "tdur"))
        return wall / 1e3, processor / 1e3


def wait_for(page: Any, condition: str) -> None:
    end = time.monotonic() + PATIENCE
    while not page.evaluate(condition):
        if time.monotonic() > end:
            sys.exit(f"after {PATIENCE:g} s still not: {condition}")
        page.wait_for_timeout(POLL)


def opening(browser: Any, server: Server, file: Path | None) -> dict[str, float]:
    """Figures of a page that opens the server's surface, or a file that is dropped on it."""
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.set_default_timeout(1e3 * PATIENCE)
    trace = Trace(page)
    start, before = time.perf_counter(), (server.processor, drawing())
    page.goto(server.address)
    if file is not None:
        wait_for(page, EMPTY)
        start, before = time.perf_counter(), (server.processor, drawing())
        page.locator("#message input[type=file]").set_input_files(file)
    figures = {}
    for what, condition in (("picture", SHOWN), ("tets", CHOOSING)):
        wait_for(page, condition)
        page.evaluate(DRAWN)
        figures[f"{what}_seconds"] = time.perf_counter() - start
        figures[f"{what}_server_seconds"] = server.processor - before[0]
        figures[f"{what}_drawing_seconds"] = drawing() - before[1]
    page.mouse.move(640, 400)  # the first ray
    page.wait_for_timeout(1000)
    figures["longest_ms"], figures["longest_processor_ms"] = trace.longest()
    page.close()
    return figures


def checking(file: Path) -> tuple[int, dict[str, float]]:
    """Number of faces, and seconds of `snapspace check` without starting Python."""
    start, busy = time.perf_counter(), time.process_time()
    report = ss.check_surface(*ss.read_surface(file))
    wall, processor = time.perf_counter() - start, time.process_time() - busy
    return report.faces, {"check_seconds": wall, "check_processor_seconds": processor}


def rows(figures: dict[str, Any]) -> list[tuple[str, Any, str]]:
    return [
        (f"{how}: {name}", figures[how][key], goal)
        for how in ("view", "upload")
        for name, key, goal in (
            ("seconds to the picture of the surface", "picture_seconds", "<= 10"),
            ("... processor time of the server, s", "picture_server_seconds", ""),
            ("... processor time of drawing, s", "picture_drawing_seconds", ""),
            ("seconds to the tets", "tets_seconds", ""),
            ("... processor time of the server, s", "tets_server_seconds", ""),
            ("... processor time of drawing, s", "tets_drawing_seconds", ""),
            ("longest task of the main thread, ms", "longest_ms", "<= 200"),
            ("... in processor time, ms", "longest_processor_ms", "<= 200"),
        )
    ] + [
        ("check: seconds", figures["check_seconds"], ""),
        ("check: ... processor time, s", figures["check_processor_seconds"], ""),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("surface", nargs="?", type=Path, help="default: a generated surface")
    parser.add_argument("--rings", type=int, default=305, help="rings of the generated surface")
    parser.add_argument("--edge-length", default="0.025", help="as for view")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    program = shutil.which("chromium") or sys.exit("needs chromium on the path")
    size = ("--edge-length", args.edge_length)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = args.surface
        if file is None:
            file = Path(folder) / "large.ply"
            ss.write_surface(file, *large_surface(args.rings))
        browser = playwright.chromium.launch(executable_path=program, args=SOFTWARE_WEBGL)
        with Server(str(file), *size) as server:
            view = opening(browser, server, None)
        with Server(*size) as server:
            upload = opening(browser, server, file)
        browser.close()
        faces, check = checking(file)
    figures = {"surface": file.name, "faces": faces, "view": view, "upload": upload, **check}
    common.show(f"{file.name}, {faces} faces", rows(figures), figures, args.json)


if __name__ == "__main__":
    sys.exit(main())
