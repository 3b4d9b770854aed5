"""Serving the page until Ctrl-C."""

from __future__ import annotations

import secrets
import signal
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ..extras import need_extra
from ..reduction import ReducedModel
from .hosts import hosts_for, shown_host
from .listener import listening
from .settings import UPLOAD_LIMIT, ServerSettings
from .shared_body import SharedBody
from .surface_filling import SurfaceFilling

HOST = "127.0.0.1"


def serve(
    model: ReducedModel | None = None,
    *,
    body: SharedBody | None = None,
    title: str,
    up: str | None = None,
    folder: Path = Path(),
    upload_limit: int = UPLOAD_LIMIT,
    filling: SurfaceFilling | None = None,
    host: str = HOST,
    port: int = 0,
    ready: Callable[[str], None] = print,
) -> None:
    """Serves the page, to any number of browsers, until Ctrl-C.

    With a model it is posed or blended, and all is solved in the page. Else handles are chosen on a
    mesh, and models are computed here.

    Parameters
    ----------
    model : PosingModel or InterpolationModel, optional
    body : SharedBody, optional
        The mesh that pages begin with. With neither they ask for one.
    title : str
        Heading of the page, until a mesh has a name.
    up : "x", "y" or "z", default that of the model or problem, or z
        Axis that points up at first.
    folder : Path, default the current one
        Where what is made of uploaded meshes, and of a model, is saved.
    upload_limit : int, default 256 MB
        Bytes of a mesh that is dropped on the page.
    filling : SurfaceFilling, default quick tets
        Of surfaces that are dropped on the page.
    host : str, default "127.0.0.1"
        Address to listen at. Another one than this machine's own lets other machines in, who need
        the token. "0.0.0.0" and "::" are all addresses of this machine; requests may then name any
        address in digits, or this machine's own name.
    port : int, default 0
        0 takes any that is free.
    ready : callable, default print
        Gets the address with its token once connections are accepted.

    Raises
    ------
    MissingExtraError
        A ValueError, without the extra `snapspace[view]`.
    ValueError
        If the address cannot be listened at, or for a model that pages do not solve.
    """
    need_extra("view", who="the server of the page")
    from .app import page_app
    from .asgi_server import run

    listener = listening(host, port)
    token = secrets.token_urlsafe(18)
    try:
        with _terminated_alike(), _scratch_folder() as scratch:
            settings = ServerSettings(
                title=title,
                up=up,
                token=token,
                folder=folder.resolve(),
                scratch=scratch,
                body=body,
                model=model,
                upload_limit=upload_limit,
                filling=filling or SurfaceFilling(),
            )
            address = f"http://{shown_host(host)}:{listener.getsockname()[1]}/?token={token}"
            run(page_app(settings, hosts=hosts_for(host)), listener, started=lambda: ready(address))
    except KeyboardInterrupt:  # uvicorn has closed everything, and raises it again
        pass
    finally:
        listener.close()


@contextmanager
def _scratch_folder() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="snapspace-", ignore_cleanup_errors=True) as name:
        yield Path(name)


@contextmanager
def _terminated_alike() -> Iterator[None]:
    """SIGTERM ends the block as Ctrl-C does, so that temporary files are removed."""
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread gets signals
        return

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    # uvicorn has its own handler while it runs, and then raises the signal again for this one
    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
