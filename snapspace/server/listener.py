"""The socket on which a server listens."""

from __future__ import annotations

import errno
import socket


def listening(host: str, port: int) -> socket.socket:
    """A listening socket; port 0 takes any free one. ValueError with the cure if it fails."""
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
            f"cannot listen on {host}:{port}: {error.strerror or error}; {cure}"
        ) from None
    except OverflowError:
        listener.close()
        raise ValueError(f"port is {port}, but it must be from 0 to 65535") from None
    return listener
