"""Connections that do not say what they want are closed."""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol

#: From the beginning of a connection, or of its next request, until all headers are there.
#: A browser sends them in one piece; a tunnel across the world takes a second.
HEADER_SECONDS = 10.0


class PromptHeaders(H11Protocol):
    """HTTP as uvicorn speaks it, for clients whose headers come within `HEADER_SECONDS`.

    Any local program can connect without a token. Without this limit, connections that send their
    headers slowly or not at all would stay open, until the server has no files left.
    """

    header_seconds = HEADER_SECONDS
    _deadline: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Begins to count."""
        super().connection_made(transport)
        self._await_headers()

    def data_received(self, data: bytes) -> None:
        """Counts while headers are incomplete; their first byte after a request starts it again."""
        super().data_received(data)
        if self._is_served():
            self._forget()
        elif self._deadline is None:
            self._await_headers()

    def connection_lost(self, exc: Exception | None) -> None:
        """Ends all counting."""
        self._forget()
        super().connection_lost(exc)

    def _is_served(self) -> bool:
        """Whether a request is answered now, or the connection is a websocket's by now."""
        if self.transport.is_closing() or self.transport.get_protocol() is not self:
            return True
        return self.cycle is not None and not self.cycle.response_complete

    def _await_headers(self) -> None:
        self._deadline = self.loop.call_later(self.header_seconds, self.transport.close)

    def _forget(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None
