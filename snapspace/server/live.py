"""The websocket of a page."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress

from starlette.concurrency import run_in_threadpool
from starlette.websockets import WebSocket, WebSocketDisconnect

from .messages import Failed
from .outbox import Outbox
from .wire import decoded, encoded, request_of
from .workspace import Workspace
from .workspaces import Workspaces

#: Largest message in bytes. All vertex indices of a mesh with a million vertices take 8 MB.
LARGEST_MESSAGE = 16 * 2**20
#: Close code when another page takes over the workspace. The page reads this number.
TAKEN_OVER = 4001


def live_endpoint(workspaces: Workspaces) -> Callable[[WebSocket], Awaitable[None]]:
    """Answers connections of pages.

    Each page has its workspace: a new one or, with workspace=ID in the query, that of an earlier
    connection.
    """

    async def live(socket: WebSocket) -> None:
        await socket.accept()
        outbox = Outbox(asyncio.get_running_loop())

        async def dismiss() -> None:
            with suppress(WebSocketDisconnect, RuntimeError, OSError):  # it is closed already
                await socket.close(TAKEN_OVER)

        sender = asyncio.create_task(_send(socket, outbox))
        try:
            workspace = await workspaces.enter(
                socket.query_params.get("workspace"), outbox.put, dismiss
            )
            try:
                await _receive(socket, workspace, outbox)
            finally:
                await workspaces.leave(workspace, dismiss)
        finally:
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)

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
        return  # the page is gone; _receive sees it too
