"""Which requests a local server answers."""

from __future__ import annotations

import hmac
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOCAL = frozenset({"127.0.0.1", "localhost", "::1"})
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class Guard:
    """Answers requests only that name this host, come from its own page, and carry the token.

    Another page in the same browser could reach a local port: by its name in the Host header
    (DNS rebinding), or with an Origin of its own. Other users of the machine do not know the token.
    The port may be another one, as of a tunnel.

    Parameters
    ----------
    app : ASGIApp
    token : str
        In the query as token=...
    hosts : frozenset of str, default the names of this machine
        Names that a request may call the server by.
    """

    def __init__(self, app: ASGIApp, *, token: str, hosts: frozenset[str] = LOCAL) -> None:
        self._app = app
        self._token = token.encode()
        self._hosts = hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(Headers(scope=scope), scope["query_string"])

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                added = [(k.lower().encode(), v.encode()) for k, v in HEADERS.items()]
                message["headers"] = [*message["headers"], *added]
            await send(message)

        answer = self._app if refusal is None else PlainTextResponse(refusal, status_code=403)
        await answer(scope, receive, send_guarded)

    def _refusal(self, headers: Headers, query: bytes) -> str | None:
        host = headers.get("host", "")
        if _name(f"//{host}") not in self._hosts:
            return "snapspace: this server does not go by that name; use the address it printed"
        origin = headers.get("origin")
        if origin is not None and origin != f"http://{host}":
            return "snapspace: requests from other pages are refused"
        given = [part[6:] for part in query.split(b"&") if part.startswith(b"token=")]
        if len(given) != 1 or not hmac.compare_digest(given[0], self._token):
            return "snapspace: the token is missing or wrong; use the whole address it printed"
        return None


def _name(address: str) -> str | None:
    try:
        return urlsplit(address).hostname
    except ValueError:  # a bracket without its other half
        return None
