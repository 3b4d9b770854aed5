"""A page takes a surface as a solid or as a shell; open surfaces are shells by themselves."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from snapspace import (
    Corotational,
    ShellMesh,
    StableNeoHookean,
    open_surface,
    write_surface,
)
from snapspace.filling import SurfaceFilling
from snapspace.mesh import solid_of
from snapspace.server import messages as m
from snapspace.server.bodies import mesh_body
from snapspace.server.body import Body
from snapspace.server.body_choice import BodyChoice
from snapspace.server.body_session import BodySession
from snapspace.server.materials import fitted_material, material_choices
from snapspace.server.models import Models
from snapspace.server.settings import ServerSettings
from snapspace.server.user_surface import UserSurface
from snapspace.server.workspace import Workspace

from ..shapes import bar_problem
from ..shells.sheets import sheet, sphere
from .held_filling import HeldFilling
from .test_workspace import Mailbox

BAR = solid_of(bar_problem().mesh, who="a test")
FIN = [[0, 1, 2], [1, 0, 3], [0, 1, 4]]
SHEET = sheet(8, 4, size=(2.0, 1.0))


def surface_file(folder: Path, *, closed: bool) -> Path:
    path = folder / "it.obj"
    mesh = BAR if closed else SHEET
    write_surface(path, mesh.vertices, mesh.surface)
    return path


def no_stage(*_: object) -> None:
    pass


def ends(vertices: np.ndarray, kept: str = "first") -> tuple[m.HandleChoice, ...]:
    x = vertices[:, 0]
    low, high = np.flatnonzero(x < x.min() + 0.3), np.flatnonzero(x > x.max() - 0.3)
    return (
        m.HandleChoice(name=kept, vertices=tuple(low.tolist()), moving=False),
        m.HandleChoice(name="last", vertices=tuple(high.tolist())),
    )


def choose(vertices: np.ndarray, thickness: float | None) -> m.Choose:
    return m.Choose(
        request=1,
        handles=ends(vertices),
        translation=(0.1, 0.1, 0.1),
        angle=(0.2, 0.2, 0.2),
        thickness=thickness,
    )


def test_an_open_surface_is_a_shell_by_itself_and_a_closed_one_is_filled(tmp_path: Path) -> None:
    shell = mesh_body(surface_file(tmp_path, closed=False), stage=no_stage)
    assert isinstance(shell.mesh, ShellMesh)
    assert shell.mesh.thickness == pytest.approx(0.02 * shell.mesh.diagonal, rel=0.05)
    path = surface_file(tmp_path, closed=True)
    filling = HeldFilling(outcome=BAR)
    filling.let_go.set()
    assert mesh_body(path, stage=no_stage, filling=filling).mesh is BAR
    assert isinstance(mesh_body(path, stage=no_stage, thickness=0.1).mesh, ShellMesh)


def test_a_small_hole_is_a_fault_and_a_wide_one_makes_a_shell(tmp_path: Path) -> None:
    ball = sphere(4)
    path = tmp_path / "ball.ply"
    height = ball.vertices[ball.triangles, 2].mean(axis=1)
    for missing, is_shell in ((0, False), (1, False), (400, True)):
        write_surface(path, ball.vertices, ball.triangles[np.argsort(-height)[missing:]])
        source = open_surface(path).compact()
        surface = UserSurface(name="ball", source=source, folder=tmp_path, path=path)
        assert (surface.own_shell() is not None) == is_shell


def test_an_open_surface_that_is_no_shell_is_left_to_the_filling(tmp_path: Path) -> None:
    path = tmp_path / "fin.ply"
    write_surface(path, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], FIN)
    source = open_surface(path).compact()
    surface = UserSurface(name="fin", source=source, folder=tmp_path, path=path)
    assert surface.own_shell() is None
    with pytest.raises(ValueError, match=r"fin.ply: .*edge"):
        surface.shell(0.1)


def test_a_filled_surface_becomes_a_shell_with_the_same_handles(tmp_path: Path) -> None:
    filling = HeldFilling(outcome=BAR)
    filling.let_go.set()
    body = mesh_body(surface_file(tmp_path, closed=True), stage=no_stage, filling=filling)
    assert body.surface is not None
    session = BodySession(body, Models())
    shown = body.surface.vertices(body.mesh.vertices)
    for thickness in (0.05, None, 0.07):
        assert session.choose(choose(shown, thickness)).handles == ("first", "last")
        saved = session.save(m.Save(request=2))
        content = json.loads(Path(saved.problem or "").read_text(encoding="utf-8"))
        painted = [handle["painted"] for handle in content["handles"]]
        assert painted == [list(handle.vertices) for handle in ends(shown)]
        expected = None if thickness is None else {"shell": {"thickness": thickness}}
        assert content.get("body") == expected
        usual = {"model": "stable-neo-hookean", "lam": 1.0, "mu": 1.0}
        rigid = {"model": "arap", "mu": 1.0, "radius": 0.02}
        assert content["material"] == (usual if thickness is None else rigid)
        assert ("mesh" in content) == (thickness is None)


def test_a_shell_of_the_same_thickness_is_the_same(tmp_path: Path) -> None:
    body = mesh_body(surface_file(tmp_path, closed=False), stage=no_stage, thickness=0.1)
    bodies = BodyChoice(body)
    assert bodies.of(None) is body and bodies.of(0.1) is body
    other = bodies.of(0.2)
    assert bodies.of(0.2) is other and other.mesh is not body.mesh
    with pytest.raises(ValueError, match="thickness is -1"):
        bodies.of(-1.0)


def test_tets_are_no_shell(tmp_path: Path) -> None:
    bodies = BodyChoice(Body(name="bar", mesh=BAR, file=None, folder=tmp_path))
    with pytest.raises(ValueError, match="this mesh came as tets"):
        bodies.of(0.1)


def test_a_material_that_shells_lack_is_replaced_by_one_with_the_same_moduli(
    tmp_path: Path,
) -> None:
    body = mesh_body(surface_file(tmp_path, closed=False), stage=no_stage)
    moduli = np.linspace(1.0, 3.0, 7)
    fitted = fitted_material(Corotational(lam=0.5, mu=moduli), body.mesh)
    assert isinstance(fitted, StableNeoHookean)
    assert (fitted.lam, fitted.mu) == (0.5, pytest.approx(2.0))
    made = {choice.kind for choice in material_choices() if choice.makes_shells}
    assert made == {"stable-neo-hookean", "stvk", "arap"}


def dropped(
    folder: Path, filling: SurfaceFilling | None, *, closed: bool
) -> tuple[Workspace, Mailbox]:
    """A surface that is dropped on a page."""
    mailbox = Mailbox()
    settings = ServerSettings(
        title="", up=None, token="t", folder=folder, scratch=folder, filling=filling
    )
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    upload = folder / "upload"
    upload.mkdir()
    workspace.upload(surface_file(upload, closed=closed))
    mailbox.wait_for(m.Workspace, kind="surface" if closed else "mesh")
    return workspace, mailbox


def last(mailbox: Mailbox, kind: type) -> m.Workspace:
    found = [message for message in mailbox.messages if isinstance(message, kind)][-1]
    assert isinstance(found, m.Workspace)
    return found


def keep(opened: m.Workspace, vertices: np.ndarray) -> m.Keep:
    return m.Keep(
        request=0,
        handles=ends(vertices, "kept"),
        parts=(),
        translation=opened.translation,
        angle=opened.angle,
        target_error=0.01,
        most_samples=None,
        stiffness=opened.stiffness,
        material=opened.material,
        poisson=None,
        up="x",
        thickness=opened.thickness,
    )


def test_an_open_surface_says_that_it_is_open_and_can_be_filled(tmp_path: Path) -> None:
    workspace, mailbox = dropped(tmp_path, None, closed=False)
    opened = last(mailbox, m.Workspace)
    assert opened.is_open and not opened.is_filled and opened.has_surface
    assert opened.thickness == opened.usual_thickness is not None
    workspace.receive(keep(opened, SHEET.vertices))
    before = len(mailbox.messages)
    workspace.receive(m.Reopen(request=4))  # a sheet encloses no volume
    mailbox.wait_for(m.Failed, request=0)
    told = [m.kind for m in mailbox.messages[before:] if hasattr(m, "kind")]
    assert told == ["surface", "mesh"], "the shell is there again"
    again = last(mailbox, m.Workspace)
    assert again.thickness == opened.thickness and again.up == "x"
    assert [handle.name for handle in again.handles] == ["kept", "last"]
    workspace.close()


def test_a_surface_that_is_being_filled_becomes_a_shell_at_once_and_back(tmp_path: Path) -> None:
    filling = HeldFilling(outcome=BAR)
    workspace, mailbox = dropped(tmp_path, filling, closed=True)
    thickness = last(mailbox, m.Workspace).usual_thickness
    assert thickness is not None
    workspace.receive(m.Reopen(request=3, thickness=-thickness))
    mailbox.wait_for(m.Failed, request=3)
    assert workspace._jobs.working, "it is still filled"
    workspace.receive(m.Reopen(request=4, thickness=thickness))
    mailbox.wait_for(m.Workspace, kind="mesh", thickness=thickness, is_filled=False)
    shell = last(mailbox, m.Workspace)
    assert not shell.is_open
    content = workspace.mesh_content(2) or b""
    workspace.receive(keep(shell, BAR.vertices[BAR.surface_vertices]))
    workspace.receive(m.Reopen(request=5))
    mailbox.wait_for(m.Progress, stage="filling")
    workspace.receive(m.Cancel(request=6))
    mailbox.wait_for(m.Cancelled, request=6)
    assert last(mailbox, m.Workspace).thickness == thickness
    filling.let_go.set()
    workspace.receive(m.Reopen(request=7))
    mailbox.wait_for(m.Workspace, kind="mesh", is_filled=True)
    solid = last(mailbox, m.Workspace)
    assert solid.thickness is None and solid.handles[0].name == "kept" and solid.up == "x"
    again_content = workspace.mesh_content(4) or b""
    assert again_content[-len(BAR.surface) :] == content[-len(BAR.surface) :]
    workspace.pause()
    again = Mailbox()
    workspace.resume(again.put)
    assert replace(last(again, m.Workspace), is_running=False).handles == solid.handles
    workspace.close()


def test_shells_are_computed_saved_and_given_back_after_a_reload(tmp_path: Path) -> None:
    workspace, mailbox = dropped(tmp_path, None, closed=False)
    opened = last(mailbox, m.Workspace)
    order = m.Compute(request=2, target_error=0.5, most_samples=20, seed=0, stiffness=100.0)
    workspace.receive(keep(replace(opened, thickness=0.25), SHEET.vertices))
    workspace.receive(choose(SHEET.vertices, 0.25))
    workspace.receive(replace(order, material="corotational"))
    mailbox.wait_for(m.Failed, request=2)
    workspace.receive(replace(order, request=3))
    mailbox.wait_for(m.Model, request=3, final=True)
    model = workspace._models.newest
    assert model is not None and isinstance(model.model.problem.mesh, ShellMesh)
    assert model.model.problem.mesh.thickness == 0.25
    workspace.pause()
    again = Mailbox()
    workspace.resume(again.put)
    assert last(again, m.Workspace).thickness == 0.25
    workspace.close()
