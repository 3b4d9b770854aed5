"""The websocket of a page."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

from starlette.concurrency import run_in_threadpool
from starlette.websockets import WebSocket, WebSocketDisconnect

from .messages import Failed
from .outbox import Outbox
from .site import Site
from .wire import decoded, encoded, request_of
from .workspace import Workspace

#: Bytes of a message: all vertices of a mesh with a million of them are 8 MB.
LARGEST_MESSAGE = 16 * 2**20


def live_endpoint(
    site: Site, workspaces: dict[str, Workspace]
) -> Callable[[WebSocket], Awaitable[None]]:
    """Answers connections of pages; each has its workspace, which ends with the connection.

    Parameters
    ----------
    site : Site
    workspaces : dict
        By id, those of the pages that are connected.
    """

    async def live(socket: WebSocket) -> None:
        await socket.accept()
        outbox = Outbox(asyncio.get_running_loop())
        workspace = Workspace(site, outbox.put)
        workspaces[workspace.id] = workspace
        sender = asyncio.create_task(_send(socket, outbox))
        try:
            await run_in_threadpool(workspace.open)
            await _receive(socket, workspace, outbox)
        finally:
            del workspaces[workspace.id]
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)
            await run_in_threadpool(workspace.close)

    return live


async def _receive(socket: WebSocket, workspace: Workspace, outbox: Outbox) -> None:
    while True:
        event = await socket.receive()
        if event["type"] == "websocket.disconnect":
            return
        await run_in_threadpool(_take, event.get("text"), workspace, outbox)


def _take(text: str | None, workspace: Workspace, outbox: Outbox) -> None:
    try:
        if text is None:
            raise ValueError("message: must be text, got a binary frame")
        message = decoded(text)
    except ValueError as error:
        request = 0 if text is None else request_of(text)
        outbox.put(Failed(request=request, message=str(error)))
        return
    workspace.receive(message)


async def _send(socket: WebSocket, outbox: Outbox) -> None:
    try:
        while True:
            item = await outbox.get()
            if isinstance(item, bytes):
                await socket.send_bytes(item)
            else:
                await socket.send_text(await run_in_threadpool(encoded, item))
    except (WebSocketDisconnect, RuntimeError, OSError):
        return  # the page is gone; the receiving side sees it too
