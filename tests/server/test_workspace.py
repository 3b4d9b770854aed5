"""A closed page leaves no memory, files or messages behind; errors become answers."""

from __future__ import annotations

import gc
import threading
import weakref
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from snapspace.mesh import write_tets
from snapspace.server.body import Body
from snapspace.server.messages import Cancel, Cancelled, Choose, Chosen, Compute, Failed, Model
from snapspace.server.messages import Workspace as Opened
from snapspace.server.selection import choices_of
from snapspace.server.settings import ServerSettings
from snapspace.server.shared_body import SharedBody
from snapspace.server.workspace import Workspace

from ..shapes import bar_problem

PATIENCE = 60.0
ORDER = Compute(request=1, target_error=0.5, most_samples=20, seed=0, stiffness=100.0)


class Mailbox:
    """Collects a workspace's messages in place of a page."""

    def __init__(self) -> None:
        self.messages: list[object] = []
        self._arrived = threading.Condition()

    def put(self, *items: object) -> None:
        with self._arrived:
            self.messages.extend(items)
            self._arrived.notify_all()

    def wait_for(self, message: type, **fields: object) -> None:
        def has_arrived() -> bool:
            return any(
                isinstance(m, message) and all(getattr(m, k) == v for k, v in fields.items())
                for m in self.messages
            )

        with self._arrived:
            assert self._arrived.wait_for(has_arrived, PATIENCE), self.messages


@pytest.fixture
def settings(tmp_path: Path) -> ServerSettings:
    problem = bar_problem()
    body = Body(name="bar", mesh=problem.mesh, file=None, folder=tmp_path, problem=problem)
    shared = SharedBody(lambda stage: body)
    return ServerSettings(
        title="", up="z", token="t", folder=tmp_path, scratch=tmp_path, body=shared
    )


def opened(settings: ServerSettings) -> tuple[Workspace, Mailbox]:
    """A workspace whose mesh has been read, and the messages that it sends."""
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    mailbox.wait_for(Opened, kind="mesh")
    return workspace, mailbox


@pytest.fixture
def no_collector() -> Iterator[None]:
    gc.collect()
    gc.disable()
    yield
    gc.enable()


def test_a_closed_page_holds_no_memory(settings: ServerSettings, no_collector: None) -> None:
    """Memory is free before cycles are collected: samples are large, collections rare."""
    workspace, mailbox = opened(settings)
    workspace.receive(ORDER)
    mailbox.wait_for(Model, final=True)
    assert workspace._session is not None and workspace._models.newest is not None
    model = workspace._models.newest.model
    references = [weakref.ref(workspace._session), weakref.ref(model)]
    del model
    workspace.close()
    assert [one() for one in references] == [None, None]


def test_poissons_ratio_changes_lam_and_null_is_the_material_of_the_file(
    settings: ServerSettings,
) -> None:
    workspace, mailbox = opened(settings)
    materials = []
    for request, ratio in enumerate((None, 0.4, None), start=1):
        workspace.receive(replace(ORDER, request=request, poisson=ratio))
        mailbox.wait_for(Model, request=request, final=True)
        assert workspace._models.newest is not None
        materials.append(workspace._models.newest.model.problem.material)
    workspace.close()
    assert materials[0] == materials[2] == bar_problem().material
    lam, mu = materials[1].lam, materials[1].mu
    assert mu == materials[0].mu and lam / (2 * (lam + mu)) == pytest.approx(0.4)


def test_each_material_starts_from_the_samples_of_the_last_one(settings: ServerSettings) -> None:
    workspace, mailbox = opened(settings)
    for request, kind in enumerate(("stvk", "arap", "stable-neo-hookean"), start=1):
        workspace.receive(replace(ORDER, request=request, material=kind))
        mailbox.wait_for(Model, request=request, final=True)
        assert workspace._models.newest is not None
        assert workspace._models.newest.model.problem.material.kind == kind
    workspace.close()
    assert not any(isinstance(message, Failed) for message in mailbox.messages)


def test_a_removed_handle_is_gone_at_once(settings: ServerSettings) -> None:
    workspace, mailbox = opened(settings)
    order = replace(ORDER, material="stable-neo-hookean", target_error=1e-4, most_samples=40)
    every = choices_of(bar_problem())
    for request, chosen in enumerate((every, every[:2]), start=1):
        bounds = (0.8, 0.8, 0.8)
        workspace.receive(
            Choose(request=10 + request, handles=chosen, translation=bounds, angle=bounds)
        )
        mailbox.wait_for(Chosen, request=10 + request)
        workspace.receive(replace(order, request=request))
        mailbox.wait_for(Model, request=request, final=True)
    workspace.close()
    assert not any(isinstance(message, Failed) for message in mailbox.messages)
    models = [m for m in mailbox.messages if isinstance(m, Model)]
    last_of_three = next(m for m in models if m.request == 1 and m.final)
    first_of_two = next(m for m in models if m.request == 2)
    assert first_of_two.dimension == last_of_three.dimension, "it is the same subspace"


def refusal(settings: ServerSettings, monkeypatch: pytest.MonkeyPatch, error: Exception) -> Failed:
    """The message that a page gets when a computation raises an error."""

    def raises(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("snapspace.server.computation.growing_models", raises)
    workspace, mailbox = opened(settings)
    workspace.receive(ORDER)
    mailbox.wait_for(Failed, request=1)
    workspace.close()
    (failed,) = (m for m in mailbox.messages if isinstance(m, Failed))
    return failed


def test_a_fault_is_answered_and_its_traceback_logged(
    settings: ServerSettings, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    failed = refusal(settings, monkeypatch, KeyError("a fault of ours"))
    assert failed.message.startswith("the server has a bug") and "\n" not in failed.message
    assert "a fault of ours" in caplog.text and caplog.records[0].exc_info


def test_a_lack_of_memory_is_reported_with_its_cure(
    settings: ServerSettings, monkeypatch: pytest.MonkeyPatch
) -> None:
    failed = refusal(settings, monkeypatch, MemoryError())
    assert "fewer samples or a coarser mesh" in failed.message


def test_a_file_that_arrives_after_its_page_closed_is_removed(
    settings: ServerSettings, tmp_path: Path
) -> None:
    path = tmp_path / "upload" / "bar.obj"
    path.parent.mkdir()
    path.write_text("")
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.close()
    workspace.upload(path)
    assert not path.parent.exists() and mailbox.messages == []


def test_a_late_end_of_an_old_mesh_does_not_hide_the_new_one(
    settings: ServerSettings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    release = threading.Event()
    problem = bar_problem()
    body = Body(name="new", mesh=problem.mesh, file=None, folder=tmp_path)

    def read(path: Path, **_: object) -> Callable[[object], Body]:
        if path.stem == "slow":
            assert release.wait(PATIENCE)
            raise ValueError("too late")
        return lambda _: body

    monkeypatch.setattr("snapspace.server.uploaded_body.read_mesh", read)
    monkeypatch.setattr("snapspace.server.workspace_jobs.STOP_SECONDS", 0.01)
    mailbox = Mailbox()
    workspace = Workspace(replace(settings, body=None), mailbox.put)
    workspace.upload(tmp_path / "a" / "slow.obj")
    late = workspace._jobs._reading
    assert late is not None
    workspace.upload(tmp_path / "b" / "new.obj")
    mailbox.wait_for(Opened, kind="mesh", name="new")
    release.set()
    assert late.wait(PATIENCE)
    kinds = [message.kind for message in mailbox.messages if isinstance(message, Opened)]
    workspace.close()
    assert kinds == ["reading", "mesh"]
    assert not any(isinstance(message, Failed) for message in mailbox.messages)


@pytest.mark.parametrize("content", ["", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"])
def test_a_file_that_cannot_be_read_leaves_all_work_as_it_is(
    settings: ServerSettings, tmp_path: Path, content: str
) -> None:
    workspace, mailbox = opened(settings)
    workspace.receive(ORDER)
    mailbox.wait_for(Model, final=True)
    session, newest, begun = workspace._session, workspace._models.newest, len(mailbox.messages)
    workspace.receive(replace(ORDER, request=2, seed=1))
    path = tmp_path / "upload" / "wrong.obj"
    path.parent.mkdir()
    path.write_text(content)
    workspace.upload(path)
    mailbox.wait_for(Failed, request=0)
    assert workspace._session is session is not None
    assert newest is not None and workspace.model_content(newest.number) is not None
    mailbox.wait_for(Model, request=2, final=True)
    assert not any(isinstance(message, Opened) for message in mailbox.messages[begun:])
    assert not path.parent.exists()
    workspace.close()


def test_cancelling_the_reading_of_a_file_leaves_the_computation(
    settings: ServerSettings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    release = threading.Event()

    def read(path: Path, **_: object) -> Callable[[object], Body]:
        assert release.wait(PATIENCE)
        raise ValueError("too late")

    monkeypatch.setattr("snapspace.server.uploaded_body.read_mesh", read)
    workspace, mailbox = opened(settings)
    workspace.receive(ORDER)
    workspace.upload(tmp_path / "a" / "slow.obj")
    workspace.receive(Cancel(request=3, upload=True))
    mailbox.wait_for(Cancelled, request=3)
    workspace.receive(Cancel(request=4, upload=True))  # none has arrived
    release.set()
    mailbox.wait_for(Model, final=True)
    workspace.close()
    assert not any(isinstance(message, Failed) for message in mailbox.messages)


def test_a_file_that_arrives_after_its_cancel_is_removed(
    settings: ServerSettings, tmp_path: Path
) -> None:
    """Messages of a page may overtake its uploads."""

    def upload(name: str, request: int) -> Path:
        path = tmp_path / name / f"{name}.mesh"
        path.parent.mkdir()
        write_tets(path, bar_problem().mesh)
        workspace.upload(path, request)
        return path.parent

    workspace, mailbox = opened(settings)
    workspace.receive(Cancel(request=3, upload=True))
    assert not upload("cancelled", 2).exists()
    upload("newer", 5)
    assert not upload("older", 4).exists()
    mailbox.wait_for(Opened, kind="mesh", name="newer")
    workspace.pause()
    workspace.resume(mailbox.put)
    upload("reloaded", 1)
    mailbox.wait_for(Opened, kind="mesh", name="reloaded")
    workspace.close()
