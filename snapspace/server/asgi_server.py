"""Running the page's application with uvicorn."""

from __future__ import annotations

import socket
from collections.abc import Callable

import uvicorn
from starlette.types import ASGIApp

from .live import LARGEST_MESSAGE
from .slow_headers import PromptHeaders

#: How long Ctrl-C waits for connections to end.
GRACE_SECONDS = 1
#: A page that is silent for longer counts as gone. Tunnels and machines that wake up may be slow.
SILENCE_SECONDS = 90


def run(app: ASGIApp, listener: socket.socket, *, started: Callable[[], None]) -> None:
    """Answers requests on a listening socket until Ctrl-C, which is raised again.

    Parameters
    ----------
    app : ASGI application
    listener : listening socket
    started : callable without arguments
        Called once connections are accepted.
    """
    config = uvicorn.Config(
        app,
        log_level="error",
        access_log=False,
        lifespan="off",
        server_header=False,
        http=PromptHeaders,
        ws="websockets-sansio",
        ws_max_size=LARGEST_MESSAGE,
        ws_ping_timeout=SILENCE_SECONDS,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=GRACE_SECONDS,
    )
    _Server(config, started).run(sockets=[listener])


class _Server(uvicorn.Server):
    """A server that calls `started` when it accepts connections."""

    def __init__(self, config: uvicorn.Config, started: Callable[[], None]) -> None:
        super().__init__(config)
        self._started = started

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets=sockets)
        self._started()
