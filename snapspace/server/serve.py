"""serve: serves the page until Ctrl-C."""

from __future__ import annotations

import secrets
import signal
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ..extras import need_extra
from ..filling import SurfaceFilling
from ..reduction import ReducedModel
from .hosts import hosts_for, shown_host
from .listener import listening
from .settings import UPLOAD_LIMIT, ServerSettings
from .shared_body import SharedBody

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

    With a model, the page poses or blends it and does all the solving. Otherwise the user chooses
    handles on a mesh, and the server computes models.

    Parameters
    ----------
    model : PosingModel or InterpolationModel, optional
    body : SharedBody, optional
        The initial mesh of pages. Without a model and a body, pages ask for a mesh.
    title : str
        Heading of the page, until a mesh has a name.
    up : "x", "y" or "z", default that of the model or problem, or of the surface's format
        Axis that points up at first.
    folder : Path, default the current one
        Where files made from uploaded meshes, or from the model, are saved.
    upload_limit : int, default 256 MB
        Largest size in bytes of a mesh that is dropped on the page.
    filling : SurfaceFilling, optional
        How to fill surfaces that are dropped on the page. Default: with quick tets; open surfaces
        become shells instead.
    host : str, default "127.0.0.1"
        Address to listen on. Addresses other than 127.0.0.1 let other machines connect, with the
        token. "0.0.0.0" and "::" mean all addresses of this machine; requests may then use any
        numeric address, or this machine's own name.
    port : int, default 0
        0 takes any free port.
    ready : callable, default print
        Called with the address and its token once connections are accepted.

    Raises
    ------
    MissingExtraError
        A ValueError, if the extra `snapspace[view]` is not installed.
    ValueError
        If the server cannot listen on the address, or for a model that the page cannot solve.
    """
    need_extra("view", who="the server of the page")
    from .app import page_app
    from .asgi_server import run

    listener = listening(host, port)
    token = secrets.token_urlsafe(18)
    try:
        with _interrupted_by_sigterm(), _scratch_folder() as scratch:
            settings = ServerSettings(
                title=title,
                up=up,
                token=token,
                folder=folder.resolve(),
                scratch=scratch,
                body=body,
                model=model,
                upload_limit=upload_limit,
                filling=filling,
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
def _interrupted_by_sigterm() -> Iterator[None]:
    """SIGTERM ends the block like Ctrl-C, so that temporary files are removed."""
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
