"""A real server, and websockets that talk to it as the page does."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlencode, urlsplit

import numpy as np
from safetensors.numpy import load
from websockets.sync.client import ClientConnection, connect

Arrays = dict[str, np.ndarray]
Message = dict[str, Any]

PATIENCE = 60.0  # seconds that a test waits for the server before it fails


class Page:
    """The page's end of a websocket."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket = socket
        self.frames: list[bytes] = []
        self.seen: list[Message] = []

    def send(self, kind: str, *, request: int = 1, **fields: Any) -> None:
        self.socket.send(json.dumps({"type": kind, "request": request, **fields}))

    def take(self, *kinds: str) -> Message:
        """The next message of one of these types; those before it are in `seen`."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            content = self.socket.recv(timeout=PATIENCE)
            if isinstance(content, bytes):
                self.frames.append(content)
                continue
            message: Message = json.loads(content)
            if message["type"] in kinds:
                return message
            self.seen.append(message)
        raise AssertionError(f"no {kinds} in time, but {self.seen[-5:]}")

    def ask(self, kind: str, answer: str, *, request: int = 1, **fields: Any) -> Message:
        """Sends a message and returns its answer, which must have the type `answer`."""
        self.send(kind, request=request, **fields)
        message = self.take(answer, "failed")
        assert message["type"] == answer, message
        assert message["request"] == request
        return message

    def workspace(self) -> Message:
        """The workspace message once the mesh is read."""
        while True:
            message = self.take("workspace", "failed")
            assert message["type"] == "workspace", message
            if message["kind"] not in ("reading", "surface"):
                return message


class Running:
    """`snapspace view` as a separate process."""

    def __init__(self, *arguments: str | Path, environment: dict[str, str] | None = None) -> None:
        inherited = {k: v for k, v in os.environ.items() if "DISPLAY" not in k}
        self.process = subprocess.Popen(
            [sys.executable, "-m", "snapspace", "view", *map(str, arguments)],
            stderr=subprocess.PIPE,
            text=True,
            env={**inherited, **(environment or {})},
        )
        assert self.process.stderr is not None
        line = self.process.stderr.readline()
        assert line.startswith("snapspace: open http://"), line
        self.address = line.split()[2]

    def get(
        self, path: str = "/", *, token: str | None = None, **headers: str
    ) -> tuple[int, bytes]:
        parts = urlsplit(self.address)
        query = parts.query if token is None else token
        request = urllib.request.Request(f"http://{parts.netloc}{path}?{query}", headers=headers)
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
                assert answer.headers["Cache-Control"] == "no-store"
                return answer.status, answer.read()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.read()

    @contextmanager
    def page(self, *, token: str | None = None, **headers: str) -> Iterator[Page]:
        """A websocket, as a page opens it."""
        parts = urlsplit(self.address)
        address = f"ws://{parts.netloc}/live?{parts.query if token is None else token}"
        with connect(
            address, additional_headers=headers, max_size=None, open_timeout=PATIENCE
        ) as socket:
            yield Page(socket)

    def fetch(self, address: str) -> Arrays:
        """The packed model or mesh at an address of a message."""
        parts = urlsplit(self.address)
        with urllib.request.urlopen(f"http://{parts.netloc}/{address}", timeout=PATIENCE) as answer:
            return load(answer.read())

    def upload(self, page: str, name: str, content: bytes | Iterable[bytes]) -> tuple[int, str]:
        """Drops a mesh on a page; returns the status and the text of the answer."""
        parts = urlsplit(self.address)
        query = urlencode({"workspace": page, "name": name})
        request = urllib.request.Request(
            f"http://{parts.netloc}/mesh?{query}&{parts.query}", data=content
        )
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
                return answer.status, answer.read().decode()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.read().decode()

    def kill(self) -> None:
        """Ends the process, whatever its state."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()

    def stop(self, how: signal.Signals = signal.SIGINT) -> tuple[int, str]:
        """Stops the server; returns its exit code and the rest of its stderr."""
        self.process.send_signal(how)
        assert self.process.stderr is not None
        with self.process.stderr as stream:  # communicate() would miss the lines already buffered
            rest = stream.read()
        return self.process.wait(timeout=PATIENCE), rest
