"""The page and a model, as an ASGI application."""

from __future__ import annotations

import html

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import Route

from ..page import packed
from ..page.page_file import PLACE, page_html
from ..reduction import ReducedModel
from .guard import LOCAL, Guard


def page_app(
    model: ReducedModel, *, title: str, up: str, token: str, hosts: frozenset[str] = LOCAL
) -> Starlette:
    """Serves the page at / and the model at /model, to requests that `Guard` lets through.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    title : str
        Heading of the page.
    up : "x", "y" or "z"
        Axis that points up at first.
    token : str
        Letters, digits, - and _ only: it becomes part of addresses.
    hosts : frozenset of str
        As for `Guard`.

    Raises
    ------
    ValueError
        If the package was made without its page.
    """
    content = packed(model, name=title, up=up)
    address = html.escape(f"model?token={token}")
    page = page_html().replace(PLACE, f'<meta name="snapspace-model" content="{address}" />')

    async def show_page(_: Request) -> Response:
        return HTMLResponse(page)

    async def send_model(_: Request) -> Response:
        return Response(content, media_type="application/octet-stream")

    return Starlette(
        routes=[Route("/", show_page), Route("/model", send_model)],
        middleware=[Middleware(Guard, token=token, hosts=hosts)],
    )
