"""Makes the picture of the web component: the example page of its npm package in headless Chromium.

Needs a chromium on the path, playwright, and Node.js with npm.

python docs/make_viewer_picture.py
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from make_page_pictures import DRAWN, FOLDER, SOFTWARE_WEBGL, model_of
from pictures_creature import creature_problem
from pictures_poses import creature_poses
from playwright.sync_api import sync_playwright

import snapspace as ss
from snapspace.generators import creature

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))

import build_viewer

TETS = 12_000
READY = "document.querySelectorAll('snapspace-viewer')[{}].model !== null"
#: Both viewers and the bar of weights fit in the picture.
LOW = "snapspace-viewer { aspect-ratio: auto; height: 360px }"
POSED = """(() => {
  const [posing, blending] = document.querySelectorAll("snapspace-viewer");
  posing.setHandles({
    head: { degrees: [0, 20, 25] }, tail: { degrees: [0, -15, 0], translation: [-0.2, 0, 0.35] },
  });
  const [, one, other] = blending.model.poses;
  blending.setWeights({ [one]: 0.6, [other]: 0.4 });
})()"""


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of a folder that is served until the end of the block."""
    server = ThreadingHTTPServer(
        ("127.0.0.1", 0), partial(SimpleHTTPRequestHandler, directory=str(folder))
    )
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()


def main() -> None:
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "viewer"
        build_viewer.build(folder)
        posing = model_of(creature_problem(TETS), 100, 30)
        blending = model_of(ss.InterpolationProblem(creature_poses(creature(TETS))), 20, 16)
        ss.export_packed(posing, folder / "posing.snapspace")
        ss.export_packed(blending, folder / "blending.snapspace")
        program = shutil.which("chromium")
        browser = playwright.chromium.launch(executable_path=program, args=SOFTWARE_WEBGL)
        with served(folder) as address:
            page = browser.new_page(viewport={"width": 820, "height": 980})
            page.goto(f"{address}/example.html")
            page.add_style_tag(content=LOW)
            for viewer in (0, 1):
                page.wait_for_function(READY.format(viewer), timeout=120_000)
            page.evaluate(POSED)
            page.evaluate(DRAWN)
            page.wait_for_timeout(500)
            page.screenshot(path=FOLDER / "web-component.png")
        browser.close()


if __name__ == "__main__":
    main()
