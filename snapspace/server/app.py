"""The page, and what it works with, as an ASGI application."""

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
from .site import Site
from .uploads import upload_endpoint
from .workspace import Workspace
from .workspaces import Workspaces

Handler = Callable[[Request], Awaitable[Response]]


def page_app(site: Site, *, hosts: Container[str] = LOCAL) -> Starlette:
    """Serves requests that `Guard` lets through.

    GET / is the page, /model the model of the site, /mesh/ID/NUMBER and /model/ID/NUMBER what a
    workspace has; POST /mesh takes uploads, and /live is the websocket, see `messages`.

    Parameters
    ----------
    site : Site
    hosts : container of str, default this machine's local names
        As for `Guard`.

    Raises
    ------
    ValueError
        If the package was made without its page, or for a model that pages do not solve.
    """
    workspaces = Workspaces(site)
    routes = [
        Route("/", _page(site)),
        Route("/mesh", upload_endpoint(site, workspaces), methods=["POST"]),
        Route("/mesh/{id}/{number:int}", _content(workspaces, Workspace.mesh_content)),
        Route("/model/{id}/{number:int}", _content(workspaces, Workspace.model_content)),
        WebSocketRoute("/live", live_endpoint(workspaces)),
    ]
    if site.model is not None:
        routes.append(Route("/model", _bytes(packed(site.model, name=site.title, up=site.up))))
    return Starlette(routes=routes, middleware=[Middleware(Guard, token=site.token, hosts=hosts)])


def _page(site: Site) -> Handler:
    """The page, told where its server is, and its model if there is one."""
    query = f"?token={site.token}"
    places = {"snapspace-server": f"live{query}"}
    if site.model is not None:
        places["snapspace-model"] = f"model{query}"
    told = "".join(
        f'<meta name="{name}" content="{html.escape(address)}" />'
        for name, address in places.items()
    )
    page = page_html().replace(PLACE, told)

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
            return PlainTextResponse("snapspace: this is not kept any more", status_code=404)
        return Response(content, media_type="application/octet-stream")

    return send
