"""PromptHeaders: closes connections that do not send their headers in time."""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol

#: Time limit from the start of a connection, or of its next request, until all headers have
#: arrived. A browser sends them in one piece; a tunnel across the world takes a second.
HEADER_SECONDS = 10.0


class PromptHeaders(H11Protocol):
    """uvicorn's HTTP protocol with a time limit, `HEADER_SECONDS`, for a request's headers.

    Any local program can connect without a token. Without this limit, connections that send their
    headers slowly or not at all would stay open, until the server has no file descriptors left.
    """

    header_seconds = HEADER_SECONDS
    _deadline: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Starts the time limit."""
        super().connection_made(transport)
        self._start_timer()

    def data_received(self, data: bytes) -> None:
        """Stops the time limit once headers are complete; the next request starts it again."""
        super().data_received(data)
        if self._is_served():
            self._stop_timer()
        elif self._deadline is None:
            self._start_timer()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stops the time limit."""
        self._stop_timer()
        super().connection_lost(exc)

    def _is_served(self) -> bool:
        """Whether a request is being answered, or the connection has become a websocket."""
        if self.transport.is_closing() or self.transport.get_protocol() is not self:
            return True
        return self.cycle is not None and not self.cycle.response_complete

    def _start_timer(self) -> None:
        self._deadline = self.loop.call_later(self.header_seconds, self.transport.close)

    def _stop_timer(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None
