"""Who is answered: requests of the server's own page, with the token."""

from __future__ import annotations

import socket
from collections.abc import Container
from typing import Any

import pytest

from snapspace.server.guard import Guard
from snapspace.server.hosts import LOCAL, OwnNames, hosts_for, shown_host


def answer(
    kind: str,
    *,
    host: str = "localhost:80",
    origin: str | None = None,
    token: str = "secret",
    hosts: Container[str] = LOCAL,
) -> str:
    """What a request meets: the application, or a refusal."""
    headers = [(b"host", host.encode())]
    headers += [] if origin is None else [(b"origin", origin.encode())]
    scope = {"type": kind, "headers": headers, "query_string": f"token={token}".encode()}
    sent: list[dict[str, Any]] = []

    async def app(scope: Any, receive: Any, send: Any) -> None:
        sent.append({"type": "the application"})

    async def send(message: Any) -> None:
        sent.append(message)

    async def receive() -> Any:
        return {"type": f"{kind}.connect"}

    answering = Guard(app, token="secret", hosts=hosts)(scope, receive, send)
    with pytest.raises(StopIteration):  # nothing is waited for, so no event loop is needed
        answering.send(None)
    return str(sent[0]["type"])


@pytest.mark.parametrize(
    ("kind", "refused"), [("http", "http.response.start"), ("websocket", "websocket.close")]
)
def test_websockets_are_guarded_as_requests_are(kind: str, refused: str) -> None:
    own = {"host": "localhost:8000", "origin": "http://localhost:8000"}
    assert answer(kind, **own) == "the application"
    assert answer(kind) == "the application", "programs that are no browsers send no Origin"
    assert answer(kind, token="wrong") == refused
    assert answer(kind, host="evil.example") == refused
    for origin in (
        "http://evil.example",
        "null",
        "http://localhost:8001",
        "https://localhost:8000",
    ):
        assert answer(kind, host="localhost:8000", origin=origin) == refused


def test_a_server_for_all_answers_to_addresses_and_its_own_name() -> None:
    own = socket.gethostname().lower()
    for host in ("192.168.3.4", "10.0.0.1", "::1", "fe80::1", "localhost", own):
        assert host in OwnNames()
    for host in (
        "evil.example",
        f"{own}.evil.example",
        "1.2.3.4.evil.example",
        "",
        "1.2.3",
        "0x7f.1",
    ):
        assert host not in OwnNames()
    everywhere = hosts_for("0.0.0.0")
    assert answer("http", host="192.168.3.4:80", hosts=everywhere) == "the application"
    assert answer("http", host="[fe80::1]:80", hosts=everywhere) == "the application"
    assert answer("http", host="evil.example", hosts=everywhere) == "http.response.start"
    assert answer("http", host="[", hosts=everywhere) == "http.response.start"


def test_other_servers_answer_to_the_name_they_listen_at() -> None:
    assert "my.host" in hosts_for("My.Host") and "localhost" in hosts_for("my.host")
    assert "192.168.3.4" not in hosts_for("my.host")


def test_the_printed_address_is_one_that_a_browser_can_open() -> None:
    assert shown_host("127.0.0.1") == "127.0.0.1"
    assert shown_host("::1") == "[::1]"
    assert shown_host("0.0.0.0") == shown_host("::") == socket.gethostname()
