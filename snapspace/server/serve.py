"""Serving the page of a model until Ctrl-C."""

from __future__ import annotations

import errno
import secrets
import socket
from collections.abc import Callable

import uvicorn

from ..reduction import ReducedModel
from .app import page_app
from .guard import LOCAL

HOST = "127.0.0.1"


def serve(
    model: ReducedModel,
    *,
    title: str,
    up: str = "z",
    host: str = HOST,
    port: int = 0,
    ready: Callable[[str], None] = print,
) -> None:
    """Serves a model's page, to any number of browsers, until Ctrl-C.

    Everything is solved in the page; the server only hands out the page and the model.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    title : str
        Heading of the page.
    up : "x", "y" or "z", default "z"
        Axis that points up at first.
    host : str, default "127.0.0.1"
        Address to listen at. Another one than this machine's own lets other machines in, who need
        the token.
    port : int, default 0
        0 takes any that is free.
    ready : callable, default print
        Gets the address with its token once connections are accepted.

    Raises
    ------
    ValueError
        If the address cannot be listened at.
    """
    listener = _listening(host, port)
    token = secrets.token_urlsafe(18)
    app = page_app(model, title=title, up=up, token=token, hosts=LOCAL | {host.lower()})
    config = uvicorn.Config(
        app, log_level="error", access_log=False, lifespan="off", server_header=False
    )
    name = f"[{host}]" if ":" in host else host
    server = _Server(
        config, lambda: ready(f"http://{name}:{listener.getsockname()[1]}/?token={token}")
    )
    try:
        server.run(sockets=[listener])
    except KeyboardInterrupt:  # uvicorn has closed everything, and raises it again
        pass
    finally:
        listener.close()


class _Server(uvicorn.Server):
    """A server that tells when it accepts connections."""

    def __init__(self, config: uvicorn.Config, started: Callable[[], None]) -> None:
        super().__init__(config)
        self._tell = started

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets=sockets)
        self._tell()


def _listening(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen()
    except OSError as error:
        listener.close()
        taken = error.errno == errno.EADDRINUSE
        cure = "give another --port" if taken else "give another --host or --port"
        raise ValueError(
            f"cannot listen at {host}:{port}: {error.strerror or error}; {cure}"
        ) from None
    except OverflowError:
        listener.close()
        raise ValueError(f"port is {port}, but ports go from 0 to 65535") from None
    return listener
