"""The socket that a server listens at."""

from __future__ import annotations

import errno
import socket


def listening(host: str, port: int) -> socket.socket:
    """A socket at an address, port 0 for any that is free; ValueError with the cure if it fails."""
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
