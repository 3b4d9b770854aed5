"""The server answers only requests of its own page that carry the token."""

from __future__ import annotations

import socket
from collections.abc import Container, Sequence
from typing import Any

import pytest

from snapspace.server.guard import Guard
from snapspace.server.hosts import LOCAL, TrustedHosts, hosts_for, shown_host


def answer(
    kind: str,
    *,
    host: str | Sequence[str] = "localhost:80",
    origin: str | Sequence[str] | None = None,
    token: str = "secret",
    hosts: Container[str] = LOCAL,
) -> str:
    """Who answers a request: the application, or the type of a refusal."""
    origins = [origin] if isinstance(origin, str) else origin or []
    given = [host] if isinstance(host, str) else host
    headers = [(b"host", one.encode("latin-1")) for one in given]
    headers += [(b"origin", one.encode()) for one in origins]
    scope = {"type": kind, "headers": headers, "query_string": f"token={token}".encode()}
    sent: list[dict[str, Any]] = []

    async def app(scope: Any, receive: Any, send: Any) -> None:
        sent.append({"type": "the application"})

    async def send(message: Any) -> None:
        sent.append(message)

    async def receive() -> Any:
        return {"type": f"{kind}.connect"}

    answering = Guard(app, token="secret", hosts=hosts)(scope, receive, send)
    with pytest.raises(StopIteration):  # the guard awaits nothing, so no event loop is needed
        answering.send(None)
    return str(sent[0]["type"])


@pytest.mark.parametrize(
    ("kind", "refused"), [("http", "http.response.start"), ("websocket", "websocket.close")]
)
def test_websockets_are_guarded_as_requests_are(kind: str, refused: str) -> None:
    own = {"host": "localhost:8000", "origin": "http://localhost:8000"}
    assert answer(kind, **own) == "the application"
    assert answer(kind) == "the application", "programs other than browsers send no Origin"
    assert answer(kind, token="wrong") == refused
    assert answer(kind, host="evil.example") == refused
    for origin in (
        "http://evil.example",
        "null",
        "http://localhost:8001",
        "https://localhost:8000",
    ):
        assert answer(kind, host="localhost:8000", origin=origin) == refused


@pytest.mark.parametrize(
    "host",
    [
        "evil.example@localhost",
        "localhost@evil.example",
        "localhost/evil.example",
        "localhost?x",
        "localhost#x",
        "localhost:80:80",
        "localhost:",
        "localhost:99999",
        "localhost:x",
        " localhost",
        "local\thost",
        "//localhost",
        "[::1",
        "::1",
        "[localhost]",
        "localhost\xa0",
        "",
        (),
        ("localhost", "localhost"),
        ("localhost", "evil.example"),
    ],
)
def test_a_host_is_matched_strictly(host: str | Sequence[str]) -> None:
    assert answer("http", host=host) == "http.response.start"
    assert answer("websocket", host=host) == "websocket.close"


def test_well_formed_hosts_are_answered() -> None:
    for host in ("localhost", "LOCALHOST:8000", "127.0.0.1:1", "[::1]", "[::1]:65535"):
        assert answer("http", host=host) == "the application"


def test_more_than_one_origin_is_refused() -> None:
    own = "http://localhost:80"
    assert answer("http", origin=[own]) == "the application"
    for origins in ([own, own], [own, "http://evil.example"], ["http://evil.example", own]):
        assert answer("http", origin=origins) == "http.response.start"
        assert answer("websocket", origin=origins) == "websocket.close"


def test_a_server_for_all_answers_to_addresses_and_its_own_name() -> None:
    own = socket.gethostname().lower()
    for host in ("192.168.3.4", "10.0.0.1", "::1", "fe80::1", "localhost", own):
        assert host in TrustedHosts()
    for host in (
        "evil.example",
        f"{own}.evil.example",
        "1.2.3.4.evil.example",
        "",
        "1.2.3",
        "0x7f.1",
    ):
        assert host not in TrustedHosts()
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
