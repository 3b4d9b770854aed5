"""Servers on threads of the test's process, which start faster than processes."""

from __future__ import annotations

import threading
from typing import Any
from urllib.parse import urlsplit

from websockets.sync.client import connect

from snapspace.server.serve import serve


def started(*, title: str = "bar", **options: Any) -> str:
    """The address of a server on a daemon thread; `options` are those of `serve`."""
    addresses: list[str] = []
    ready = threading.Event()

    def record(address: str) -> None:
        addresses.append(address)
        ready.set()

    options |= {"title": title, "ready": record}
    threading.Thread(target=serve, kwargs=options, daemon=True).start()
    assert ready.wait(30)
    return addresses[0]


def socket(address: str, id: str | None = None) -> Any:
    """A websocket as a page opens it, of a new workspace or of one that exists."""
    parts = urlsplit(address)
    query = parts.query if id is None else f"{parts.query}&workspace={id}"
    return connect(f"ws://{parts.netloc}/live?{query}", max_size=None)
