"""Host names that requests may use for a server, in their Host header."""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Container

#: This machine's local names.
LOCAL: Container[str] = frozenset({"127.0.0.1", "localhost", "::1"})

_EVERYWHERE = ("0.0.0.0", "::")


class TrustedHosts:
    """All numeric addresses, and this machine's own names.

    Another page in a browser can reach a server under the page's own name by changing the address
    of that name (DNS rebinding). Nobody can do so with a numeric address, or with a name that they
    do not control. A server that listens on all addresses does not know its own, so it trusts
    these.
    """

    def __init__(self) -> None:
        whole = socket.gethostname().lower()
        self._names = {whole, whole.partition(".")[0]} - {""}

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (
            name in LOCAL or name.rstrip(".") in self._names or _is_address(name)
        )


def hosts_for(host: str) -> Container[str]:
    """The trusted host names of a server that listens on `host`."""
    if host in _EVERYWHERE:
        return TrustedHosts()
    return frozenset({"127.0.0.1", "localhost", "::1", host.lower()})


def shown_host(host: str) -> str:
    """The host in the printed address: one that a browser can open."""
    if host in _EVERYWHERE:
        return socket.gethostname()
    return f"[{host}]" if ":" in host else host


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
