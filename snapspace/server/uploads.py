"""Uploads: mesh files that are dropped on a page."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import suppress
from pathlib import Path

from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import PlainTextResponse, Response

from ..model_file import SUFFIX
from .bodies import MESH_SUFFIXES
from .saving import plain_name
from .settings import ServerSettings
from .workspaces import Workspaces


def upload_endpoint(
    settings: ServerSettings, workspaces: Workspaces
) -> Callable[[Request], Awaitable[Response]]:
    """Answers POST requests: the body is the file, and the query has workspace=ID and name=FILE.

    With request=N the upload is numbered like the page's messages: a later `Cancel` drops the file
    even if it arrives afterwards.

    The answer is 202 once the file has arrived; the websocket sends the rest. Errors are one line
    of text: 400 for an interrupted upload, 404 for a page that is not connected, 413 beyond the
    limit, 415 for a file that is neither a mesh nor a model.

    Parameters
    ----------
    settings : ServerSettings
    workspaces : Workspaces
    """

    async def upload(request: Request) -> Response:
        body = request.stream()
        answer = await taken(request, body)
        # read the rest of a refused upload, since a client that is still sending would miss the
        # answer
        with suppress(ClientDisconnect):
            async for _ in body:
                pass
        return answer

    async def taken(request: Request, body: AsyncIterator[bytes]) -> Response:
        workspace = workspaces.get(request.query_params.get("workspace", ""))
        name = plain_name(request.query_params.get("name", ""))
        number = request.query_params.get("request", "0")
        if workspace is None:
            return _refusal(404, "the page of this upload is not connected; reload it")
        if Path(name).suffix.lower() not in (*MESH_SUFFIXES, SUFFIX):
            return _refusal(415, f"{name}: a page takes meshes, {' '.join(MESH_SUFFIXES)}")
        if not number.isdecimal():
            return _refusal(400, f"{name}: request must be a whole number, got {number}")
        too_large = f"{name}: more than {settings.upload_limit / 2**20:g} MB; raise --upload-limit"
        if int(request.headers.get("content-length", "0")) > settings.upload_limit:
            return _refusal(413, too_large)
        place = Path(tempfile.mkdtemp(dir=settings.scratch)) / name
        try:
            complete = await _received(body, place, settings.upload_limit)
        except (ClientDisconnect, OSError) as error:
            await run_in_threadpool(shutil.rmtree, place.parent, ignore_errors=True)
            return _refusal(
                400, f"{name}: the upload broke off ({type(error).__name__}); try again"
            )
        if not complete:
            await run_in_threadpool(shutil.rmtree, place.parent, ignore_errors=True)
            return _refusal(413, too_large)
        await run_in_threadpool(workspace.upload, place, int(number))
        return Response(status_code=202)

    return upload


async def _received(body: AsyncIterator[bytes], place: Path, limit: int) -> bool:
    """Writes the body of a request to a file, and reads no further than the limit."""
    size = 0
    with place.open("wb") as file:
        async for part in body:
            size += len(part)
            if size > limit:
                return False
            file.write(part)
    return True


def _refusal(status: int, text: str) -> Response:
    return PlainTextResponse(f"snapspace: {text}", status_code=status)
