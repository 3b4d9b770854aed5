"""A page takes over the workspace of a connection that died without a word."""

from __future__ import annotations

import asyncio
import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, cast

import pytest
from starlette.websockets import WebSocket, WebSocketDisconnect

from snapspace.server.live import TAKEN_OVER, live_endpoint
from snapspace.server.settings import ServerSettings
from snapspace.server.workspaces import Workspaces


class Connection:
    """A websocket that is open until `end`; closing it raises `fault`."""

    def __init__(self, workspace: str | None = None, fault: Exception | None = None) -> None:
        self.query_params = {} if workspace is None else {"workspace": workspace}
        self.sent: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self.closed: list[int] = []
        self._fault = fault
        self._ended = asyncio.Event()

    async def accept(self) -> None:
        pass

    async def receive(self) -> dict[str, str]:
        await self._ended.wait()
        return {"type": "websocket.disconnect"}

    async def send_text(self, text: str) -> None:
        self.sent.put_nowait(json.loads(text))

    async def close(self, code: int) -> None:
        self.closed.append(code)
        if self._fault is not None:
            raise self._fault

    def end(self) -> None:
        self._ended.set()

    async def workspace(self) -> str:
        """The id in the first message."""
        return str((await asyncio.wait_for(self.sent.get(), 30))["id"])


@pytest.mark.parametrize("fault", [WebSocketDisconnect(1006), RuntimeError(), OSError(), None])
def test_however_the_old_connection_ended(tmp_path: Path, fault: Exception | None) -> None:
    settings = ServerSettings(title="", up="z", token="t", folder=tmp_path, scratch=tmp_path)
    live = live_endpoint(Workspaces(settings))

    async def scenario() -> None:
        old = Connection(fault=fault)
        first = asyncio.create_task(live(cast(WebSocket, old)))
        name = await old.workspace()
        new = Connection(workspace=name)
        second = asyncio.create_task(live(cast(WebSocket, new)))
        assert await new.workspace() == name, "the same workspace"
        assert old.closed == [TAKEN_OVER]
        for connection in (old, new):
            connection.end()
        await asyncio.gather(first, second)
        left = asyncio.all_tasks() - {asyncio.current_task()}
        for task in left:  # the workspace waits for its page
            task.cancel()
        await asyncio.gather(*left, return_exceptions=True)

    # Playwright's loop may run in this thread
    with ThreadPoolExecutor(1) as thread:
        thread.submit(asyncio.run, scenario()).result()
