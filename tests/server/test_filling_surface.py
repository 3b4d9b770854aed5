"""A surface is shown as soon as it has been read: while it is filled, and if that fails."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import write_surface, write_tets
from snapspace.filling import SurfaceFilling
from snapspace.mesh import SurfaceFile
from snapspace.server.bodies import mesh_body
from snapspace.server.body import Body
from snapspace.server.messages import Cancel, Cancelled, Check, Checked, Failed, Progress
from snapspace.server.messages import Workspace as Opened
from snapspace.server.opening import Opening
from snapspace.server.settings import ServerSettings
from snapspace.server.shared_body import SharedBody
from snapspace.server.workspace import Workspace

from ..shapes import bar_problem
from .held_filling import HeldFilling
from .test_workspace import Mailbox

BAR = bar_problem().mesh


def dropped(folder: Path, filling: SurfaceFilling) -> tuple[Workspace, Mailbox]:
    """The surface of a bar, dropped on a page."""
    mailbox = Mailbox()
    settings = ServerSettings(
        title="", up=None, token="t", folder=folder, scratch=folder, filling=filling
    )
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    path = folder / "upload" / "bar.obj"
    path.parent.mkdir()
    write_surface(path, BAR.vertices, BAR.surface)
    workspace.upload(path)
    mailbox.wait_for(Progress, stage="filling")
    return workspace, mailbox


def kinds(mailbox: Mailbox) -> list[str]:
    """Kinds of workspaces, stages and types of other messages, in their order."""
    return [
        message.kind
        if isinstance(message, Opened)
        else message.stage
        if isinstance(message, Progress)
        else type(message).__name__
        for message in mailbox.messages
    ]


def shown(mailbox: Mailbox, kind: str) -> Opened:
    (found,) = (m for m in mailbox.messages if isinstance(m, Opened) and m.kind == kind)
    return found


def test_a_surface_comes_before_its_tets_and_is_the_same_after(tmp_path: Path) -> None:
    filling = HeldFilling(outcome=BAR)
    workspace, mailbox = dropped(tmp_path, filling)
    surface = shown(mailbox, "surface")
    assert (surface.name, surface.up, surface.has_surface) == ("bar", "y", True)
    assert surface.diagonal == pytest.approx(BAR.diagonal)
    before = workspace.mesh_content(1)
    workspace.receive(Check(request=5))
    mailbox.wait_for(Checked, request=5, fine=True)
    filling.let_go.set()
    mailbox.wait_for(Opened, kind="mesh")
    assert shown(mailbox, "mesh").mesh == surface.mesh
    assert workspace.mesh_content(1) == before, "the page need not fetch it again"
    workspace.close()
    found = [kind for kind in kinds(mailbox) if kind != "Checked"]
    assert found == ["empty", "reading", "reading", "surface", "filling", "mesh"]


def test_a_surface_stays_if_it_cannot_be_filled_also_after_a_reload(tmp_path: Path) -> None:
    filling = HeldFilling(outcome="too thin; use --exact")
    workspace, mailbox = dropped(tmp_path, filling)
    filling.let_go.set()
    mailbox.wait_for(Failed, request=0)
    assert kinds(mailbox)[-3:] == ["surface", "filling", "Failed"]
    assert mailbox.messages[-1] == Failed(request=0, message="bar.obj: too thin; use --exact")
    workspace.receive(Check(request=5))
    mailbox.wait_for(Checked, request=5)
    workspace.pause()
    again = Mailbox()
    workspace.resume(again.put)
    assert kinds(again) == ["surface", "Failed"]
    assert workspace.mesh_content(1) is not None
    workspace.close()


def test_a_page_that_is_loaded_again_while_a_surface_is_filled_shows_it(tmp_path: Path) -> None:
    filling = HeldFilling(outcome=BAR)
    workspace, _ = dropped(tmp_path, filling)
    workspace.pause()
    again = Mailbox()
    workspace.resume(again.put)
    assert kinds(again) == ["surface", "filling"]
    filling.let_go.set()
    again.wait_for(Opened, kind="mesh")
    workspace.close()


def test_filling_can_be_cancelled_or_replaced(tmp_path: Path) -> None:
    workspace, mailbox = dropped(tmp_path, HeldFilling(outcome=BAR))
    workspace.receive(Cancel(request=6))
    mailbox.wait_for(Cancelled, request=6)
    assert kinds(mailbox)[-2:] == ["empty", "Cancelled"]
    assert workspace.mesh_content(1) is None

    again = tmp_path / "again"
    again.mkdir()
    workspace, mailbox = dropped(again, HeldFilling(outcome=BAR))
    other = again / "other" / "other.mesh"
    other.parent.mkdir()
    other.write_text("no mesh")
    workspace.upload(other)
    mailbox.wait_for(Failed, request=0)
    assert kinds(mailbox)[-2:] == ["reading", "Failed"]
    assert workspace.mesh_content(1) is not None, "the surface stays, and is still filled"
    other.parent.mkdir()
    write_tets(other, BAR)
    workspace.upload(other)
    mailbox.wait_for(Opened, kind="mesh", name="other")
    assert workspace.mesh_content(1) is None
    workspace.close()


def test_a_page_that_waits_for_another_one_sees_the_surface(tmp_path: Path) -> None:
    path = tmp_path / "bar.ply"
    write_surface(path, BAR.vertices, BAR.surface)
    filling = HeldFilling(outcome=BAR)

    def make(opening: Opening) -> Body:
        return mesh_body(path, stage=opening.stage, filling=filling, read=opening.read)

    settings = ServerSettings(
        title="", up="z", token="t", folder=tmp_path, scratch=tmp_path, body=SharedBody(make)
    )
    pages = [Mailbox(), Mailbox()]
    workspaces = [Workspace(settings, page.put) for page in pages]
    for workspace, page in zip(workspaces, pages, strict=True):
        workspace.open()
        page.wait_for(Opened, kind="surface")
    pages[1].wait_for(Progress, stage="waiting")
    filling.let_go.set()
    for workspace, page in zip(workspaces, pages, strict=True):
        page.wait_for(Opened, kind="mesh")
        workspace.close()


def test_what_is_not_finite_is_not_shown(tmp_path: Path) -> None:
    path = tmp_path / "bar.ply"
    write_surface(path, BAR.vertices, BAR.surface)
    header, data = path.read_bytes().split(b"end_header\n", 1)
    path.write_bytes(header + b"end_header\n" + b"\xff" * 24 + data[24:])
    told: list[SurfaceFile] = []
    with pytest.raises(ValueError, match="not finite"):
        mesh_body(path, stage=lambda *_: None, read=told.append)
    assert not told
