"""Workspace: the state of one page, and its work in the background."""

from __future__ import annotations

import logging
import secrets
import shutil
import threading
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path

from ..mesh import SurfaceFile
from ..stopping import check_stop
from . import messages
from .body import Body, model_body
from .body_session import BodySession
from .empty_workspace import empty_workspace, surface_workspace
from .exports import Exports
from .job import Job
from .mesh_pack import packed_mesh, packed_surface
from .models import Models
from .opening import Opening
from .page_channel import PageChannel
from .page_computation import page_computation
from .polish_jobs import PolishJobs
from .reader_text import text_of
from .recorded import recorded
from .reporter import Reporter
from .settings import ServerSettings
from .surface_check import surface_check
from .uploaded_body import uploaded_body

#: How long to wait for stopped work to end: solvers check between the parts of an iteration.
STOP_SECONDS = 0.4


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
        self._lock = threading.Lock()  # for the calls; jobs do not take it
        self._work: Job | None = None
        self._check: Job | None = None
        self._polishes = PolishJobs(self._emit, self._fail)
        self._surface: SurfaceFile | None = None  # while it is filled, and after that failed
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
            self._emit.connect(emit, self._present)

    def _present(self, begun: messages.Workspace) -> messages.Workspace:
        """The workspace with the page's choices since."""
        running = self._work is not None and self._work.running
        now = replace(
            begun,
            job=self._job,
            is_running=running and self._job > 0,
            has_model=self._models.newest is not None,
        )
        kept = self._draft
        if kept is None or begun.kind != "mesh":
            return now
        chosen = {field.name: getattr(kept, field.name) for field in fields(kept)}
        del chosen["request"]
        chosen |= {"poisson": begun.poisson, "own_poisson": kept.poisson}
        return replace(now, **chosen)

    def upload(self, path: Path) -> None:
        """Opens a mesh or model file in place of the current one, see `uploaded_body`."""
        with self._lock:
            if self._closed:  # the page closed during the upload
                shutil.rmtree(path.parent, ignore_errors=True)
            else:
                self._open(lambda to: uploaded_body(path, to, self._settings), path.stem)

    def receive(self, message: messages.PageMessage) -> None:
        """Answers a message, at once or in a job."""
        with self._lock:
            try:
                self._answer(message)
            except Exception as error:
                self._fail(message.request, error)

    def mesh_content(self, number: int) -> bytes | None:
        """The packed mesh of an address; None if it has been replaced."""
        surface, session = self._surface, self._session
        if number == self._meshes and session is not None:
            return packed_mesh(session.body, up=self._up)
        if number == self._meshes and surface is not None:
            return packed_surface(surface, name=Path(surface.name).stem, up=self._up)
        return None

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
            all_jobs = (self._work, self._check, self._polishes.stop())
            jobs = [job for job in all_jobs if job is not None]
            for job in jobs:
                job.stop()
            for job in jobs:
                job.wait(STOP_SECONDS)
            # explicitly: jobs refer to this, and the garbage collector does not see their size
            self._work = self._check = self._session = self._surface = None
            self._polishes = PolishJobs(self._emit, self._fail)
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
            self._surface = None
            self._end_work()
            self._emit(messages.Cancelled(request=message.request))
        elif isinstance(message, messages.Save):
            self._emit(self._current_session().save(message))
        elif isinstance(message, messages.Export):
            self._export(message)
        elif isinstance(message, messages.Keep):
            self._draft = message
        elif isinstance(message, messages.Edit):
            self._edit()
        elif isinstance(message, messages.Check):
            shown = self._surface or self._current_session().body
            self._check_surface(shown, message.request)
        else:
            self._polishes.begin(message, self._models.get(message.model))

    def _current_session(self) -> BodySession:
        if self._session is None:
            raise ValueError("there is no mesh yet; drop one on the page, or wait until it is read")
        return self._session

    def _own_session(self) -> BodySession:
        """The session of the model that the page began with, to improve it."""
        model, title, folder = self._models.current, self._settings.title, self._settings.folder
        if model is not None:
            self._session = BodySession(model_body(model, name=title, folder=folder), self._models)
        return self._current_session()

    def _export(self, order: messages.Export) -> None:
        """Keeps a model with what was made on its page, until that page fetches it."""
        order, session = replace(order, up=order.up or self._up), self._session
        model, name = self._models.get(order.model), self._settings.title
        if session is None:
            model = recorded(model, up=order.up, timeline=order.timeline)
        else:
            model, name = session.recorded(model, order), session.body.name
        self._exports.keep(order.model, name, model)
        address = self._address("page", order.model)
        self._emit(messages.Exported(request=order.request, address=address))

    def _edit(self) -> None:
        own, title, folder = self._settings.model, self._settings.title, self._settings.folder
        if own is None:
            raise ValueError("this server has no model of its own; choose handles on its mesh")
        model = self._models.current or own
        self._open(lambda _: model_body(model, name=title, folder=folder), title)

    def _check_surface(self, shown: Body | SurfaceFile, request: int) -> None:
        """Examines a surface in the background, beside other work."""
        if self._check is not None:
            self._check.stop()
        self._check = Job(
            lambda: self._send(surface_check(shown, request)),
            failed=lambda error: self._fail(request, error),
        )

    def _compute(self, order: messages.Compute | messages.Extend) -> None:
        begins = isinstance(order, messages.Extend) and self._session is None
        computation = page_computation(
            order,
            self._own_session() if begins else self._current_session(),
            self._models,
            queue=self._settings.queue,
            up=lambda: self._up,
            address=lambda number: self._address("model", number),
            send=self._send,
        )
        self._end_work()
        self._job = order.request
        self._work = Job(computation.run, failed=lambda error: self._fail(order.request, error))

    def _open(self, make: Callable[[Opening], Body], name: str) -> None:
        """Begins to make a body; the page is sent a workspace once its surface or it is ready."""
        self._end_work()
        self._session = self._surface = None
        self._models.clear()
        self._exports.clear()
        self._draft, self._job = None, 0
        self._meshes += 1
        number, empty = self._meshes, self._empty()
        address = self._address("mesh", number)
        self._emit(replace(empty, kind="reading", name=name))
        report = Reporter(self._send, 0)

        def show(surface: SurfaceFile) -> None:
            check_stop()
            self._surface = surface
            self._emit(surface_workspace(empty, surface, name=name, mesh=address))

        def work() -> None:
            try:
                body = make(Opening(report.send, show))
                check_stop()
                session = BodySession(body, self._models)
                self._session, self._surface = session, None
                self._emit(session.begin(empty, mesh=address))
            except BaseException:
                # otherwise another mesh has replaced this one, or its surface stays
                if number == self._meshes and self._surface is None:
                    self._emit(empty)
                raise

        self._work = Job(work, failed=lambda error: self._fail(0, error))

    def _end_work(self) -> None:
        if self._work is not None:
            self._work.stop()
            self._work.wait(STOP_SECONDS)

    def _send(self, message: messages.ServerMessage) -> None:
        """Sends a message of a job, unless the job was stopped."""
        check_stop()
        self._emit(message)

    def _fail(self, request: int, error: Exception) -> None:
        if not isinstance(error, MemoryError | ValueError):
            logging.getLogger(__name__).error("request %d failed", request, exc_info=error)
        text = text_of(error)
        self._emit(messages.Failed(request=request, message=text.replace("\n", " ")))

    @property
    def _up(self) -> str:
        """The axis of the page, else of the server's settings, else of the file."""
        if self._draft is not None:
            return self._draft.up
        if self._settings.up is not None:
            return self._settings.up
        session, model = self._session, self._settings.model
        if session is not None:
            return session.body.up or "z"
        if self._surface is not None:
            return self._surface.up
        return "z" if model is None else model.up

    def _address(self, what: str, number: int) -> str:
        return f"{what}/{self.id}/{number}?token={self._settings.token}"

    def _empty(self) -> messages.Workspace:
        return empty_workspace(self._settings, name=self.id, up=self._up)
