"""What a page leaves behind: nothing."""

from __future__ import annotations

import gc
import threading
import weakref
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from snapspace.server.body import Body
from snapspace.server.messages import Compute, Failed, Model
from snapspace.server.messages import Workspace as Opened
from snapspace.server.settings import ServerSettings
from snapspace.server.shared_body import SharedBody
from snapspace.server.workspace import Workspace

from ..shapes import bar_problem

PATIENCE = 60.0
ORDER = Compute(request=1, target_error=0.5, most_samples=20, seed=0, stiffness=100.0)


class Mailbox:
    """Messages of a workspace, without a page."""

    def __init__(self) -> None:
        self.messages: list[object] = []
        self._came = threading.Condition()

    def put(self, *items: object) -> None:
        with self._came:
            self.messages.extend(items)
            self._came.notify_all()

    def wait_for(self, message: type, **fields: object) -> None:
        def is_here() -> bool:
            return any(
                isinstance(m, message) and all(getattr(m, k) == v for k, v in fields.items())
                for m in self.messages
            )

        with self._came:
            assert self._came.wait_for(is_here, PATIENCE), self.messages


@pytest.fixture
def settings(tmp_path: Path) -> ServerSettings:
    problem = bar_problem()
    body = Body(name="bar", mesh=problem.mesh, file=None, folder=tmp_path, problem=problem)
    shared = SharedBody(lambda stage: body)
    return ServerSettings(
        title="", up="z", token="t", folder=tmp_path, scratch=tmp_path, body=shared
    )


@pytest.fixture
def no_collector() -> Iterator[None]:
    gc.collect()
    gc.disable()
    yield
    gc.enable()


def test_a_closed_page_holds_no_memory(settings: ServerSettings, no_collector: None) -> None:
    """Not even until cycles are collected: samples are large, and objects that hold them few."""
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    mailbox.wait_for(Opened, kind="mesh")
    workspace.receive(ORDER)
    mailbox.wait_for(Model, final=True)
    held = [weakref.ref(workspace._session), weakref.ref(workspace._models.newest.model)]  # type: ignore[union-attr]
    workspace.close()
    assert [one() for one in held] == [None, None]


def test_poissons_ratio_changes_lam_and_null_is_the_material_of_the_file(
    settings: ServerSettings,
) -> None:
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    mailbox.wait_for(Opened, kind="mesh")
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


def test_each_material_starts_from_the_samples_of_the_one_before(settings: ServerSettings) -> None:
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    mailbox.wait_for(Opened, kind="mesh")
    for request, kind in enumerate(("stvk", "arap", "stable-neo-hookean"), start=1):
        workspace.receive(replace(ORDER, request=request, material=kind))
        mailbox.wait_for(Model, request=request, final=True)
        assert workspace._models.newest is not None
        assert workspace._models.newest.model.problem.material.kind == kind
    workspace.close()
    assert not any(isinstance(message, Failed) for message in mailbox.messages)


def refusal(settings: ServerSettings, monkeypatch: pytest.MonkeyPatch, error: Exception) -> Failed:
    """What a page is told when a computation raises an error."""

    def raises(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("snapspace.server.computation.growing_models", raises)
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    mailbox.wait_for(Opened, kind="mesh")
    workspace.receive(ORDER)
    mailbox.wait_for(Failed, request=1)
    workspace.close()
    (failed,) = (m for m in mailbox.messages if isinstance(m, Failed))
    return failed


def test_a_fault_is_an_answer_and_leaves_a_trace(
    settings: ServerSettings, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    failed = refusal(settings, monkeypatch, KeyError("a fault of ours"))
    assert failed.message.startswith("the server has a fault") and "\n" not in failed.message
    assert "a fault of ours" in caplog.text and caplog.records[0].exc_info


def test_an_empty_memory_is_told_with_its_cure(
    settings: ServerSettings, monkeypatch: pytest.MonkeyPatch
) -> None:
    failed = refusal(settings, monkeypatch, MemoryError())
    assert "fewer samples or a coarser mesh" in failed.message


def test_a_file_that_comes_after_its_page_has_gone_is_removed(
    settings: ServerSettings, tmp_path: Path
) -> None:
    place = tmp_path / "upload" / "bar.obj"
    place.parent.mkdir()
    place.write_text("")
    mailbox = Mailbox()
    workspace = Workspace(settings, mailbox.put)
    workspace.close()
    workspace.upload(place)
    assert not place.parent.exists() and mailbox.messages == []


def test_a_late_end_of_an_old_mesh_does_not_hide_the_new_one(
    settings: ServerSettings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    release = threading.Event()
    problem = bar_problem()
    body = Body(name="new", mesh=problem.mesh, file=None, folder=tmp_path)

    def read(path: Path, **_: object) -> Body:
        if path.stem == "slow":
            assert release.wait(PATIENCE)
            raise ValueError("too late")
        return body

    monkeypatch.setattr("snapspace.server.workspace.mesh_body", read)
    monkeypatch.setattr("snapspace.server.workspace.STOP_SECONDS", 0.01)
    mailbox = Mailbox()
    workspace = Workspace(replace(settings, body=None), mailbox.put)
    workspace.upload(tmp_path / "a" / "slow.obj")
    late = workspace._work
    assert late is not None
    workspace.upload(tmp_path / "b" / "new.obj")
    mailbox.wait_for(Opened, kind="mesh", name="new")
    release.set()
    assert late.wait(PATIENCE)
    kinds = [message.kind for message in mailbox.messages if isinstance(message, Opened)]
    workspace.close()
    assert kinds == ["reading", "reading", "mesh"]
    assert not any(isinstance(message, Failed) for message in mailbox.messages)
