"""The page in headless Chromium with software rendering: opening, solving, work per frame.

    python benchmarks/page.py dragon.snapspace dragon120.snapspace

Solve times are those of the same drag in the page (WebAssembly) and in the native engine (one
thread), in one run. The drag goes straight from one random motion of the handles to the next, 60
frames each. Work per frame (main_thread.py) is what the main thread does besides drawing while a
pointer moves over the shape, grabs a handle, drags it and releases it, several times; and while a
timeline plays, whose keys are random motions. Software rendering draws some ten pictures a second,
so keys are six seconds apart: from picture to picture the shape moves as far as with a graphics
processor and keys a second apart.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import common
import main_thread
import numpy as np
from playwright.sync_api import sync_playwright

import snapspace as ss
from snapspace.page import export_html, packed

SOFTWARE_WEBGL = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
READY = "new Promise(function look(done) { snapspace.ready ? done() : setTimeout(look, 10, done) })"
FRAME = "new Promise((done) => requestAnimationFrame(done))"
DRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
# Batches of ten solves, since a page's clock may have a resolution of only 0.1 ms.
SOLVES = """(frames) => {
  const times = [];
  for (let first = 0; first < frames.length; first += 10) {
    const batch = frames.slice(first, first + 10);
    let spent = 0;
    for (const motions of batch)
      spent += snapspace.session.moveAll(new Map(motions)).milliseconds;
    times.push(spent / batch.length);
  }
  return times;
}"""
#: Between keys of the timeline.
KEY_SECONDS = 6
Motions = list[tuple[int, dict[str, list[float]]]]


def drag_path(model: ss.PosingModel, frames: int, seed: int) -> np.ndarray:
    """Parameters of a drag from rest."""
    ends = ss.sample(model.problem.domain, frames // common.PATH_FRAMES + 1, seed=seed)
    return common.along(np.vstack([np.zeros_like(ends[:1]), ends]), frames=frames)


def motions(model: ss.PosingModel, parameters: np.ndarray) -> Motions:
    """One parameter vector as motions for the page's session."""
    offsets = model.problem.offsets(parameters)
    return [
        (
            handle,
            {
                "rotation": (offset[:, :3] + np.eye(3)).ravel().tolist(),
                "translation": offset[:, 3].tolist(),
            },
        )
        for handle, offset in enumerate(offsets)
    ]


def native(model: ss.PosingModel, path: np.ndarray) -> list[float]:
    """Milliseconds of solves, as means of ten as in the page."""
    session = model.session()
    times = np.array([1e3 * session.pose(w).seconds for w in path])
    means: list[float] = times.reshape(-1, 10).mean(axis=1).tolist()
    return means


def pointer_drag(page: Any, handle: int, steps: int) -> None:
    """Moves to a handle's centre, grabs it and moves on an ellipse, one frame per step."""
    x, y = page.evaluate(f"snapspace.handle({handle})")
    for far in (60, 30, 0):
        page.mouse.move(x + far, y + far)
        page.evaluate(FRAME)
    page.mouse.down()
    for angle in np.linspace(0, 4 * np.pi, steps):
        page.mouse.move(x + 60 * np.sin(angle), y - 40 * (1 - np.cos(angle)))
        page.evaluate(FRAME)
    page.mouse.up()
    page.evaluate(DRAWN)


def timeline(model: ss.PosingModel, count: int) -> dict[str, Any]:
    """Keys of random motions, as a file for the page."""
    names = model.problem.handles.names[1:]
    ends = ss.sample(model.problem.domain, count, seed=11).reshape(count, -1, 6)
    keys = [
        {
            "time": KEY_SECONDS * key,
            "handles": {
                name: {"degrees": np.rad2deg(row[3:]).tolist(), "translation": row[:3].tolist()}
                for name, row in zip(names, rows, strict=True)
            },
        }
        for key, rows in enumerate(ends)
    ]
    return {"format": "snapspace-timeline", "version": 1, "kind": "posing", "keys": keys}


def played(page: Any, model: ss.PosingModel, keys: int) -> list[main_thread.Picture]:
    """Work of the pictures while a timeline plays."""
    content = json.dumps(timeline(model, keys)).encode()
    file = {"name": "keys.json", "mimeType": "application/json", "buffer": content}
    page.locator("input[accept='.json']").set_input_files(file)
    while page.evaluate("snapspace.timeline.timeline.keys.length") < keys:
        page.wait_for_timeout(50)
    thread = main_thread.MainThread(page)
    page.evaluate("snapspace.timeline.play(true)")
    while page.evaluate("snapspace.timeline.isPlaying"):
        page.wait_for_timeout(1000)
    return thread.pictures()


def opened_page(browser: Any, address: str) -> Any:
    """A page that has shown its model."""
    page = browser.new_page(viewport={"width": 640, "height": 400})
    page.goto(address)
    page.evaluate(READY)
    page.evaluate(DRAWN)
    return page


def summary(values: list[float]) -> dict[str, float]:
    return {
        "median": float(np.median(values)),
        "p95": float(np.percentile(values, 95)),
        "worst": float(np.max(values)),
    }


def measured(browser: Any, path: Path, args: argparse.Namespace) -> dict[str, Any]:
    """All figures of one model."""
    model = ss.load(path)
    if not isinstance(model, ss.PosingModel):
        sys.exit(f"{path}: this benchmark takes posing models")
    with tempfile.TemporaryDirectory() as folder:
        html = export_html(model, Path(folder) / "model.html")
        page = opened_page(browser, html.as_uri() + args.query)
        opened = page.evaluate("[snapspace.openedIn, snapspace.startedIn]")
        thread = main_thread.MainThread(page)
        moving = [h for h in range(len(model.problem.handles.names)) if h != 0]
        for drag in range(args.drags):
            pointer_drag(page, moving[drag % len(moving)], args.steps)
        pictures = thread.pictures()
        page.evaluate("snapspace.session.reset()")
        path_of_drag = drag_path(model, args.frames, seed=7)
        solves = page.evaluate(SOLVES, [motions(model, w) for w in path_of_drag])
        shown = page.evaluate("snapspace.session.model.space.vertices")
        page.close()
        page = opened_page(browser, html.as_uri() + args.query)
        film = played(page, model, args.keys)
        page.close()
    return {
        "model": path.name,
        "dimension": model.dimension,
        "surface_vertices": shown,
        "packed_bytes": len(packed(model, name=path.stem)),
        "opened_ms": opened[0],
        "started_ms": opened[1],
        "solve": summary(solves),
        "native_solve": summary(native(model, path_of_drag)),
        "work": summary([picture.own.wall for picture in pictures]),
        "cpu_work": summary([picture.own.cpu for picture in pictures]),
        "cpu_tester": summary([picture.tester.cpu for picture in pictures]),
        "cpu_painting": summary([picture.painting.cpu for picture in pictures]),
        "cpu_thread": summary([picture.thread.cpu for picture in pictures]),
        "frames": len(pictures),
        "timeline_frames": len(film),
        "timeline_work": summary([picture.own.wall for picture in film]),
        "timeline_cpu_work": summary([picture.own.cpu for picture in film]),
    }


def rows(figures: dict[str, Any]) -> list[tuple[str, Any, str]]:
    solve, native_solve = figures["solve"], figures["native_solve"]
    work, cpu = figures["work"], figures["cpu_work"]
    film, film_cpu = figures["timeline_work"], figures["timeline_cpu_work"]
    goal = "<= 1.5 at d = 40" if figures["dimension"] <= 40 else ""
    return [
        ("surface vertices", figures["surface_vertices"], ""),
        ("model in the page, MB", figures["packed_bytes"] / 1e6, ""),
        ("from the model's bytes to the first picture, ms", figures["opened_ms"], "<= 1500"),
        ("from the page's start to the first picture, ms", figures["started_ms"], ""),
        ("solve in WebAssembly, ms, median", solve["median"], goal),
        ("solve in WebAssembly, ms, 95 %", solve["p95"], ""),
        ("solve of the native engine, ms, median", native_solve["median"], ""),
        ("times slower than native", solve["median"] / native_solve["median"], ""),
        ("main thread besides drawing, ms, median", work["median"], "<= 3 at 25k"),
        ("... 95 %", work["p95"], "<= 3 at 25k"),
        ("... worst", work["worst"], ""),
        ("the same, its processor time, ms, median", cpu["median"], "<= 3 at 25k"),
        ("... 95 %", cpu["p95"], "<= 3 at 25k"),
        ("... worst", cpu["worst"], "<= 3 at 25k"),
        ("a timeline's frame besides drawing, ms, median", film["median"], "<= 3 at 25k"),
        ("its processor time, ms, median", film_cpu["median"], "<= 3 at 25k"),
        ("... 95 %", film_cpu["p95"], "<= 3 at 25k"),
        ("not included: the tester's listeners, median", figures["cpu_tester"]["median"], ""),
        ("not included: the browser's painting, median", figures["cpu_painting"]["median"], ""),
        ("all work of the thread besides drawing, median", figures["cpu_thread"]["median"], ""),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("models", nargs="+", type=Path, help=".snapspace files of posing models")
    parser.add_argument("--frames", type=int, default=300, help="frames of the simulated drag")
    parser.add_argument("--drags", type=int, default=6, help="number of drags by the pointer")
    parser.add_argument("--steps", type=int, default=30, help="steps of each of these drags")
    parser.add_argument("--keys", type=int, default=6, help="keys of the timeline")
    parser.add_argument("--query", default="", help="query of the address, such as ?deform=cpu")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    program = shutil.which("chromium") or sys.exit("needs chromium on the path")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=SOFTWARE_WEBGL)
        results = [measured(browser, path, args) for path in args.models]
        browser.close()
    if args.json:
        print(json.dumps(results))
        return
    for figures in results:
        title = f"{figures['model']}, d = {figures['dimension']}"
        common.show(title, rows(figures), figures, False)


if __name__ == "__main__":
    sys.exit(main())
