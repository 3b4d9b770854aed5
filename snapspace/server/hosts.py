"""Names that requests may call a server by, in their Host header."""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Container

#: This machine, for itself.
LOCAL: Container[str] = frozenset({"127.0.0.1", "localhost", "::1"})

_EVERYWHERE = ("0.0.0.0", "::")


class TrustedHosts:
    """All addresses, and the names that this machine gives itself.

    Another page in a browser can reach a server under a name of its own whose address it changes
    (DNS rebinding). Nobody can do so with an address written in digits, or with a name that does
    not come from them: for a server that listens everywhere these are as safe as its own address,
    which it does not know.
    """

    def __init__(self) -> None:
        whole = socket.gethostname().lower()
        self._names = {whole, whole.partition(".")[0]} - {""}

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (
            name in LOCAL or name.rstrip(".") in self._names or _is_address(name)
        )


def hosts_for(host: str) -> Container[str]:
    """The names for a server that listens at `host`."""
    if host in _EVERYWHERE:
        return TrustedHosts()
    return frozenset({"127.0.0.1", "localhost", "::1", host.lower()})


def shown_host(host: str) -> str:
    """The host in the address that is printed: one that a browser can open."""
    if host in _EVERYWHERE:
        return socket.gethostname()
    return f"[{host}]" if ":" in host else host


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
