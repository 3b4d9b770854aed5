"""Workspaces: the workspaces of connected pages, and of pages that may return."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

from starlette.concurrency import run_in_threadpool

from .page_channel import Put
from .settings import ServerSettings
from .workspace import Workspace

#: Seconds between checks whether other pages wait.
CHECK_SECONDS = 0.2

Dismiss = Callable[[], Awaitable[None]]


class Workspaces:
    """All workspaces by id. Used in one event loop.

    Parameters
    ----------
    settings : ServerSettings
    """

    def __init__(self, settings: ServerSettings) -> None:
        self._settings = settings
        self._known: dict[str, Workspace] = {}
        self._pages: dict[str, Dismiss] = {}
        self._leaving: dict[str, asyncio.Task[None]] = {}

    def get(self, id: str) -> Workspace | None:
        """The workspace of an id; None if it no longer exists."""
        return self._known.get(id)

    async def enter(self, id: str | None, put: Put, dismiss: Dismiss) -> Workspace:
        """The workspace of an id for a page, as it was left, or a new one.

        Parameters
        ----------
        id : str or None
            Id of a workspace of an earlier connection.
        put : callable
            Called with the messages for the page.
        dismiss : callable
            Ends the page's connection when another page takes its place.
        """
        known = None if id is None else self._known.get(id)
        if known is None:
            workspace = Workspace(self._settings, put)
            self._known[workspace.id], self._pages[workspace.id] = workspace, dismiss
            await run_in_threadpool(workspace.open)
            return workspace
        leaving, before = self._leaving.pop(known.id, None), self._pages.get(known.id)
        self._pages[known.id] = dismiss
        if leaving is not None:
            leaving.cancel()
        if before is not None:  # the same page on a connection that died, or a second tab
            known.pause()
            await before()
        await run_in_threadpool(known.resume, put)
        return known

    async def leave(self, workspace: Workspace, dismiss: Dismiss) -> None:
        """Called when the page with this `dismiss` is gone; it may come back for a while."""
        if self._pages.get(workspace.id) is not dismiss:
            return  # another page has taken its place
        del self._pages[workspace.id]
        workspace.pause()
        self._leaving[workspace.id] = asyncio.create_task(self._end(workspace))

    async def _end(self, workspace: Workspace) -> None:
        """Closes a workspace if its page does not come back in time, or when the server ends."""
        own = asyncio.current_task()
        try:
            timeouts, waited = self._settings.timeouts, 0.0
            while waited < timeouts.alone:
                if waited >= timeouts.waited_for and self._settings.queue.waiting:
                    break
                await asyncio.sleep(min(CHECK_SECONDS, timeouts.alone - waited))
                waited += CHECK_SECONDS
            self._known.pop(workspace.id, None)
            await run_in_threadpool(workspace.close)
        except asyncio.CancelledError:
            if self._leaving.get(workspace.id) is own:  # the server ends, and no page can return
                workspace.close()
            raise
        finally:
            if self._leaving.get(workspace.id) is own:
                del self._leaving[workspace.id]
