"""Workspace: the state of one page, and its work in the background."""

from __future__ import annotations

import secrets
import shutil
import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from ..reduction import ReducedModel
from ..stopping import check_stop
from . import messages
from .bodies import model_body
from .body import Body
from .body_session import BodySession
from .exports import Exports
from .first_workspaces import axis_up, empty_workspace, surface_workspace, with_choices
from .mesh_pack import packed_mesh
from .models import Models
from .opening import Opening
from .page_channel import PageChannel
from .page_computation import page_computation
from .reader_text import failure
from .reopening import in_another_form, reopening, surface_of
from .reporter import Reporter
from .settings import ServerSettings
from .surface_check import surface_check
from .uploaded_body import read_upload
from .user_surface import UserSurface
from .workspace_jobs import WorkspaceJobs


class Workspace:
    """Answers one page. Calls may come from any thread; long work runs in jobs.

    Parameters
    ----------
    settings : ServerSettings
    emit : callable
        Called with messages, and bytes for binary frames, from any thread; those of one call stay
        together.
    """

    def __init__(self, settings: ServerSettings, emit: Callable[..., None]) -> None:
        self.id = secrets.token_urlsafe(9)
        self._settings, self._emit = settings, PageChannel(emit)
        self._lock = threading.Lock()  # for the calls; of the jobs only that of an upload uses it
        self._jobs = WorkspaceJobs(self._emit, self._fail)
        self._surface: UserSurface | None = None  # while it is filled, and after that failed
        self._session: BodySession | None = None
        self._meshes = 0  # number of meshes opened so far; the last one is current
        self._models = Models(settings.model)
        self._exports = Exports()
        self._draft: messages.Keep | None = None
        self._job = 0  # request of the last `Compute`
        self._closed = False

    def open(self) -> None:
        """Sends the first message, and begins to read or fill the server's mesh, if any."""
        shared = self._settings.body
        if self._settings.model is not None:
            self._emit(replace(self._empty(), kind="model"))
        elif shared is None:
            self._emit(self._empty())
        else:
            with self._lock:
                self._open(shared.get, self._settings.title)

    def pause(self) -> None:
        """Disconnects the page, perhaps for a moment: the state is kept, and work continues."""
        self._emit.disconnect()

    def resume(self, emit: Callable[..., None]) -> None:
        """Connects a page that is back: sends it the state, and then new messages."""
        with self._lock:
            self._jobs.count_anew()  # like a page that was reloaded
            self._emit.connect(emit, self._present)

    def _present(self, begun: messages.Workspace) -> messages.Workspace:
        """The workspace with the page's choices since."""
        now = replace(
            begun,
            job=self._job,
            is_running=self._jobs.working and self._job > 0,
            has_model=self._models.newest is not None,
        )
        return with_choices(now, self._draft)

    def upload(self, path: Path, request: int = 0) -> None:
        """Opens a mesh or model file instead of the current one, once it has been read.

        Files that arrive after the page closed, or after a later upload or cancel, are removed.
        """
        with self._lock:
            if self._closed or not self._jobs.read(lambda: self._take_upload(path), request):
                shutil.rmtree(path.parent, ignore_errors=True)

    def _take_upload(self, path: Path) -> None:
        """Reads a file in a job. If that fails, the current body, models and work stay."""
        Reporter(self._send, 0).send("reading")
        make = read_upload(path, self._settings)
        with self._lock:
            check_stop()
            self._open(make, path.stem)

    def receive(self, message: messages.PageMessage) -> None:
        """Answers a message, at once or in a job."""
        with self._lock:
            try:
                self._answer(message)
            except Exception as error:
                self._fail(message.request, error)

    def mesh_content(self, number: int) -> bytes | None:
        """The packed mesh of an address; None if it has been replaced."""
        session = self._session
        shown = self._surface if session is None else session.body
        return None if number != self._meshes or shown is None else packed_mesh(shown, up=self._up)

    def model_content(self, number: int) -> bytes | None:
        """The packed model of an address; None if it is no longer kept."""
        kept = self._models.find(number)
        return None if kept is None else kept.content

    def page_content(self, number: int) -> bytes | None:
        """The page in one file of an address; None if it is no longer kept."""
        return self._exports.content(number)

    def close(self) -> None:
        """Stops all work, and drops its results."""
        with self._lock:
            self._closed = True
            self._jobs.stop()
            # explicitly: jobs refer to this
            self._session = self._surface = None
            self._jobs = WorkspaceJobs(self._emit, self._fail)
            self._models.clear()
            self._exports.clear()

    def _answer(self, message: messages.PageMessage) -> None:
        if isinstance(message, messages.Choose):
            self._emit(self._current_session().choose(message))
        elif isinstance(message, messages.Mirror):
            self._emit(self._current_session().mirroring.mirrored(message))
        elif isinstance(message, messages.Compute | messages.Extend):
            self._compute(message)
        elif isinstance(message, messages.Cancel):
            if message.upload:
                self._jobs.stop_reading(message.request)
            else:
                self._surface = None
                self._jobs.end_work()
            self._emit(messages.Cancelled(request=message.request))
        elif isinstance(message, messages.Save):
            self._emit(self._current_session().save(message))
        elif isinstance(message, messages.Export):
            self._export(message)
        elif isinstance(message, messages.Keep):
            self._draft = message
        elif isinstance(message, messages.Edit):
            self._edit()
        elif isinstance(message, messages.Reopen):
            self._reopen(message)
        elif isinstance(message, messages.Check):
            self._check_surface(message.request)
        else:
            self._jobs.polishes.begin(message, self._models.get(message.model))

    def _current_session(self) -> BodySession:
        if self._session is None:
            raise ValueError("there is no mesh yet; drop one on the page, or wait until it is read")
        return self._session

    def _own_session(self) -> BodySession:
        """The session of the page's initial model, to improve it."""
        if self._models.current is not None:
            self._session = BodySession(self._model_body(self._models.current), self._models)
        return self._current_session()

    def _model_body(self, model: ReducedModel) -> Body:
        return model_body(model, name=self._settings.title, folder=self._settings.folder)

    def _export(self, order: messages.Export) -> None:
        """Stores a model with the work of its page, until that page fetches it."""
        order = replace(order, up=order.up or self._up)
        self._exports.keep(order, self._models, self._session, title=self._settings.title)
        address = self._address("page", order.model)
        self._emit(messages.Exported(request=order.request, address=address))

    def _edit(self) -> None:
        own = self._settings.model
        if own is None:
            raise ValueError("this server has no model of its own; choose handles on its mesh")
        model = self._models.current or own
        self._open(lambda _: self._model_body(model), self._settings.title)

    def _reopen(self, order: messages.Reopen) -> None:
        """Fills the surface, or makes it a shell; the page's `Keep` choices stay."""
        kept = self._draft
        surface = self._surface or surface_of(self._current_session().body)
        make = reopening(surface, order.thickness, self._settings.filling)
        draft = kept and in_another_form(kept, order.thickness, surface.material)
        self._emit(messages.Reopened(request=order.request))

        self._open(make, surface.name, draft=draft, before=self._session)

    def _check_surface(self, request: int) -> None:
        """Examines a surface in the background, beside other work."""
        surface = self._surface
        shown = self._current_session().body if surface is None else surface.source
        self._jobs.check(lambda: self._send(surface_check(shown, request)), request=request)

    def _compute(self, order: messages.Compute | messages.Extend) -> None:
        begins = isinstance(order, messages.Extend) and self._session is None
        computation = page_computation(
            order,
            self._own_session() if begins else self._current_session(),
            self._models,
            queue=self._settings.queue,
            up=lambda: self._up,
            address=partial(self._address, "model"),
            send=self._send,
        )
        self._jobs.end_work()
        self._job = order.request
        self._jobs.begin(computation.run, request=order.request)

    def _open(
        self,
        make: Callable[[Opening], Body],
        name: str,
        *,
        draft: messages.Keep | None = None,
        before: BodySession | None = None,
    ) -> None:
        """Begins to make a body; the page gets a workspace once its surface or the body is ready.

        `draft` has its initial choices; `before` is the session to return to.
        """
        self._jobs.end_work()
        kept = self._draft
        self._session = self._surface = None
        self._models.clear()
        self._exports.clear()
        self._draft, self._job = draft, 0
        self._meshes += 1
        number, empty = self._meshes, self._empty()
        address = self._address("mesh", number)
        if before is None:
            self._emit(replace(empty, kind="reading", name=name))
        report = Reporter(self._send, 0)

        def show(surface: UserSurface) -> None:
            check_stop()
            self._surface = surface
            self._emit(surface_workspace(empty, surface, mesh=address))

        def begin(session: BodySession, choices: messages.Keep | None) -> None:
            self._session, self._surface, self._draft = session, None, choices
            given = session.given.give(self._models, address=partial(self._address, "model"))
            self._emit(with_choices(session.begin(empty, mesh=address), choices), *given)

        def work() -> None:
            try:
                session = BodySession(make(Opening(report.send, show)), self._models)
                session.given.pack()
                check_stop()
                begin(session, self._draft)
            except BaseException:
                # otherwise another mesh has replaced this one, or its surface stays
                if number == self._meshes and before is not None:
                    begin(before, kept)
                elif number == self._meshes and self._surface is None:
                    self._emit(empty)
                raise

        self._jobs.begin(work, request=0)

    def _send(self, message: messages.ServerMessage) -> None:
        """Sends a message of a job, unless the job was stopped."""
        check_stop()
        self._emit(message)

    def _fail(self, request: int, error: Exception) -> None:
        self._emit(failure(request, error))

    @property
    def _up(self) -> str:
        """The axis of the page, of the server's settings, or of the file, in this order."""
        body = None if self._session is None else self._session.body
        return axis_up(self._settings, self._draft, body, self._surface)

    def _address(self, what: str, number: int) -> str:
        return f"{what}/{self.id}/{number}?token={self._settings.token}"

    def _empty(self) -> messages.Workspace:
        return empty_workspace(self._settings, name=self.id, up=self._up)
