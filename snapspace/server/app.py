"""page_app: the page, its meshes and its models as an ASGI application."""

from __future__ import annotations

import html
from collections.abc import Awaitable, Callable, Container

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute

from ..page import packed
from ..page.page_file import PLACE, page_html
from .guard import Guard
from .hosts import LOCAL
from .live import live_endpoint
from .settings import ServerSettings
from .uploads import upload_endpoint
from .workspace import Workspace
from .workspaces import Workspaces

Handler = Callable[[Request], Awaitable[Response]]


def page_app(settings: ServerSettings, *, hosts: Container[str] = LOCAL) -> Starlette:
    """Serves requests that `Guard` lets through.

    GET / is the page, /model the model of the settings, and /mesh/ID/NUMBER and /model/ID/NUMBER
    are those of a workspace. /page/ID/NUMBER is a requested page in one file. POST /mesh takes
    uploads, and /live is the websocket, see `messages`.

    Parameters
    ----------
    settings : ServerSettings
    hosts : container of str, default this machine's local names
        As for `Guard`.

    Raises
    ------
    ValueError
        If the package was built without its page, or for a model that the page cannot solve.
    """
    workspaces = Workspaces(settings)
    routes = [
        Route("/", _page(settings)),
        Route("/mesh", upload_endpoint(settings, workspaces), methods=["POST"]),
        Route("/mesh/{id}/{number:int}", _content(workspaces, Workspace.mesh_content)),
        Route("/model/{id}/{number:int}", _content(workspaces, Workspace.model_content)),
        Route("/page/{id}/{number:int}", _content(workspaces, Workspace.page_content)),
        WebSocketRoute("/live", live_endpoint(workspaces)),
    ]
    if settings.model is not None:
        content = packed(settings.model, name=settings.title, up=settings.up)
        routes.append(Route("/model", _bytes(content)))
    return Starlette(
        routes=routes, middleware=[Middleware(Guard, token=settings.token, hosts=hosts)]
    )


def _page(settings: ServerSettings) -> Handler:
    """The page with the addresses of its server and of its model, if there is one."""
    query = f"?token={settings.token}"
    places = {"snapspace-server": f"live{query}"}
    if settings.model is not None:
        places["snapspace-model"] = f"model{query}"
    tags = "".join(
        f'<meta name="{name}" content="{html.escape(address)}" />'
        for name, address in places.items()
    )
    page = page_html().replace(PLACE, tags)

    async def show_page(_: Request) -> Response:
        return HTMLResponse(page)

    return show_page


def _bytes(content: bytes) -> Handler:
    async def send(_: Request) -> Response:
        return Response(content, media_type="application/octet-stream")

    return send


def _content(workspaces: Workspaces, get: Callable[[Workspace, int], bytes | None]) -> Handler:
    async def send(request: Request) -> Response:
        workspace = workspaces.get(request.path_params["id"])
        content = None
        if workspace is not None:
            content = await run_in_threadpool(get, workspace, request.path_params["number"])
        if content is None:
            return PlainTextResponse("snapspace: this is no longer kept", status_code=404)
        return Response(content, media_type="application/octet-stream")

    return send
