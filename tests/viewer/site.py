"""A site with the component, like any other site: files of a folder from a plain server."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..page_numbers import numbers

SECONDS = 60.0  # software rendering on a busy machine is slow

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8"><title>Somebody's page</title><link rel="icon" href="data:,">
{head}
</head>
<body style="margin: 0; background: #dde">
{body}
</body>
</html>
"""
SCRIPT = '<script type="module" src="dist/snapspace-viewer.js"></script>'


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:
        pass


@contextmanager
def site(folder: Path) -> Iterator[str]:
    """The address of a folder that is served until the end of the block."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(folder)))
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


class Viewer:
    """The component of an open page, and the faults of the page."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.faults: list[str] = []
        page.on("console", self._console)
        page.on("pageerror", self._exception)

    def close(self) -> None:
        """Leaves the page; its tab can show another one."""
        self.page.goto("about:blank")
        self.page.remove_listener("console", self._console)
        self.page.remove_listener("pageerror", self._exception)

    def _exception(self, error: Any) -> None:
        self.faults.append(f"exception: {error}")

    def _console(self, message: Any) -> None:
        if message.type in ("error", "warning") and "GPU stall" not in message.text:
            self.faults.append(f"console: {message.text}")

    def open(self, address: str) -> None:
        self.page.goto(address)
        self.wait("viewer.model !== null")

    def run(self, script: str) -> Any:
        """Evaluates an expression in which `viewer` is the component."""
        return self.page.evaluate(_with_viewer(script))

    def numbers(self, expression: str) -> NDArray[np.float64]:
        """The values of an array of numbers, or of a promise of one."""
        return numbers(self.page, _with_viewer(expression))

    def wait(self, condition: str) -> None:
        self.page.wait_for_function(
            _with_viewer(f"viewer && ({condition})"),
            timeout=1000 * SECONDS,
        )

    def settle(self) -> None:
        """Waits for two pictures."""
        self.page.evaluate(
            "new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))"
        )

    @property
    def shape(self) -> NDArray[np.float64]:
        """Vertices of the surface as it is shown."""
        return self.numbers("viewer.shape().positions").reshape(-1, 3)


def _with_viewer(expression: str) -> str:
    """An expression in which `viewer` is the component."""
    return (
        "(() => { const viewer = document.querySelector('snapspace-viewer'); "
        f"return ({expression}); }})()"
    )
