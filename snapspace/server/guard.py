"""Guard: decides which requests a local server answers."""

from __future__ import annotations

import hmac
import re
from collections.abc import Container

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from .hosts import LOCAL

HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}

LAST_PORT = 65535
#: A name, a numeric address or an IPv6 address in brackets; and a port.
_HOST = re.compile(
    r"(?:\[(?P<address>[0-9A-Fa-f:.]+)\]|(?P<name>[0-9A-Za-z_.-]+))(?::(?P<port>[0-9]{1,5}))?",
    re.ASCII,
)


class Guard:
    """Answers only requests that name this host, come from its own page, and carry the token.

    This includes websockets, since browsers let any page open one to any server.

    Another page in the same browser could reach a local port, either by its own name in the Host
    header (DNS rebinding), or with its own Origin. Other users of the machine do not know the
    token. The port may differ, for example behind a tunnel.

    Parameters
    ----------
    app : ASGIApp
        The guarded application.
    token : str
        The token that the query must have as token=...
    hosts : container of str, default this machine's local names
        Host names that a request may use for the server.
    """

    def __init__(self, app: ASGIApp, *, token: str, hosts: Container[str] = LOCAL) -> None:
        self._app = app
        self._token = token.encode()
        self._hosts = hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):  # lifespan events, from the server itself
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(Headers(scope=scope), scope["query_string"])
        if scope["type"] == "websocket":
            # closing before accepting answers the handshake with 403
            answer = self._app if refusal is None else WebSocketClose(1008, refusal)
            await answer(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                added = [(k.lower().encode(), v.encode()) for k, v in HEADERS.items()]
                message["headers"] = [*message["headers"], *added]
            await send(message)

        page = self._app if refusal is None else PlainTextResponse(refusal, status_code=403)
        await page(scope, receive, send_guarded)

    def _refusal(self, headers: Headers, query: bytes) -> str | None:
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if len(hosts) != 1 or _name(hosts[0]) not in self._hosts:
            return "snapspace: this server does not go by that name; use the address it printed"
        # browsers send one Origin; with two, different parsers might use different ones
        if len(origins) > 1 or any(origin != f"http://{hosts[0]}" for origin in origins):
            return "snapspace: requests from other pages are refused"
        given = [part[6:] for part in query.split(b"&") if part.startswith(b"token=")]
        if len(given) != 1 or not hmac.compare_digest(given[0], self._token):
            return "snapspace: the token is missing or wrong; use the whole address it printed"
        return None


def _name(host: str) -> str | None:
    """The name in a Host header, in lower case and without its port; None if it is malformed.

    The check is strict because parsers disagree about user@name, name/path or spaces.
    """
    found = _HOST.fullmatch(host)
    if found is None or int(found["port"] or 0) > LAST_PORT:
        return None
    return (found["address"] or found["name"]).lower()
