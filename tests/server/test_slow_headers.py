"""Connections that send their headers slowly, or never, are closed; others stay."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from websockets.sync.client import connect

from snapspace.server.slow_headers import PromptHeaders

from .in_process import started

SECONDS = 0.3


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a server without a mesh, on a thread, that waits for headers only briefly."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(PromptHeaders, "header_seconds", SECONDS)
        yield started(title="slow", folder=tmp_path_factory.mktemp("slow"))


def seconds_until_closed(stream: socket.socket) -> float:
    begin = time.monotonic()
    stream.settimeout(30)
    while stream.recv(4096):
        pass
    return time.monotonic() - begin


@pytest.mark.parametrize("sent", [b"", b"GET / HTT", b"GET / HTTP/1.1\r\nHost: localhost\r\n"])
def test_slow_headers_time_out(address: str, sent: bytes) -> None:
    where = urlsplit(address)
    with socket.create_connection((where.hostname, where.port)) as stream:
        stream.sendall(sent)
        assert 0.5 * SECONDS < seconds_until_closed(stream) < 20 * SECONDS


def test_single_bytes_do_not_extend_the_time(address: str) -> None:
    where = urlsplit(address)
    with socket.create_connection((where.hostname, where.port)) as stream:
        begin = time.monotonic()
        with pytest.raises(OSError):  # the server closes it
            while time.monotonic() < begin + 30 * SECONDS:
                stream.sendall(b"G")
                time.sleep(SECONDS / 5)


def test_websockets_and_kept_connections_stay(address: str) -> None:
    where = urlsplit(address)
    with connect(f"ws://{where.netloc}/live?{where.query}") as page:
        page.recv(timeout=30)
        time.sleep(2 * SECONDS)
        page.send('{"type": "cancel", "request": 7}')
        assert '"cancelled"' in page.recv(timeout=30)
    with socket.create_connection((where.hostname, where.port)) as stream:
        stream.settimeout(30)
        request = f"GET /mesh/x/1?{where.query} HTTP/1.1\r\nHost: {where.netloc}\r\n\r\n".encode()
        for _ in range(2):
            stream.sendall(request)
            answer = b""
            while b"no longer kept" not in answer:
                answer += stream.recv(4096)
            assert answer.startswith(b"HTTP/1.1 404")
            time.sleep(1.5 * SECONDS)  # idle between requests: only keep-alive limits that
