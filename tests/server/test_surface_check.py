"""A page learns what is wrong with a surface, and what was invented before it was filled."""

from __future__ import annotations

import warnings
from pathlib import Path

import meshio
import numpy as np
import pytest

from snapspace.filling import SurfaceFilling
from snapspace.mesh import MeshNotice, write_surface
from snapspace.server.bodies import mesh_body
from snapspace.server.body import Body
from snapspace.server.messages import Check, Checked, Failed
from snapspace.server.messages import Workspace as Opened
from snapspace.server.opening import Opening
from snapspace.server.reopening import reopening, surface_of
from snapspace.server.settings import ServerSettings
from snapspace.server.shared_body import SharedBody
from snapspace.server.surface_check import surface_check
from snapspace.server.workspace import Workspace

from ..shapes import bar_problem
from .test_workspace import Mailbox

COARSE = SurfaceFilling(edge_length=0.5)


def scan(
    folder: Path, faces: slice = slice(1, None), *, filling: SurfaceFilling | None = None
) -> Body:
    """A bar from a file; by default the first of its faces is missing."""
    mesh = bar_problem().mesh
    path = folder / "scan.obj"
    write_surface(path, mesh.vertices, mesh.surface[faces])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MeshNotice)
        return mesh_body(path, stage=lambda *_: None, filling=filling)


def test_holes_are_found_and_what_closes_them_is_sent(tmp_path: Path) -> None:
    body = scan(tmp_path)
    assert body.up == "y", "as in most .obj files"
    answer = surface_check(body, 7)
    assert (answer.request, answer.fine) == (7, False)
    first = answer.findings[0]
    assert first.name == "holes" and first.fault
    assert "snapspace check --fix" in first.cure
    assert any(note.startswith("closed 1 hole with") for note in answer.mended)
    corners = np.array(answer.invented).reshape(-1, 3, 3)
    mesh = bar_problem().mesh
    missing = mesh.vertices[mesh.surface[0]]
    assert sorted(corners[0].tolist()) == sorted(missing.astype(np.float32).tolist())
    assert len(corners) == 1


def test_a_closed_surface_is_fine(tmp_path: Path) -> None:
    answer = surface_check(scan(tmp_path, slice(None), filling=COARSE), 1)
    assert answer.fine and not answer.invented
    assert not [note for note in answer.mended if not note.startswith("dropped")]


def test_the_body_says_what_was_mended(tmp_path: Path) -> None:
    (notice,) = scan(tmp_path, filling=COARSE).notices
    assert notice.startswith("the surface was mended for filling: ")
    assert "closed 1 hole with 1 face" in notice
    assert scan(tmp_path, slice(None), filling=COARSE).notices == ()
    assert scan(tmp_path).notices == (), "a shell is not mended"


def test_the_body_says_which_materials_are_missing_in_every_form(tmp_path: Path) -> None:
    mesh = bar_problem().mesh
    path = tmp_path / "painted.obj"
    write_surface(path, mesh.vertices, mesh.surface)
    path.write_text(f"mtllib paint.mtl\nusemtl red\n{path.read_text()}")
    with pytest.warns(MeshNotice, match="not found beside"):
        body = mesh_body(path, stage=lambda *_: None, filling=COARSE)
        shell = reopening(surface_of(body), 0.1, None)(Opening(lambda *_: None))
    (notice,) = body.notices
    assert notice.startswith("not found beside painted.obj")
    assert notice.endswith("BMP: paint.mtl; the surface is shown without them")
    assert shell.notices == (notice,)


def test_notices_name_a_file_without_its_folder(tmp_path: Path) -> None:
    mesh = bar_problem().mesh
    mirrored = meshio.Mesh(mesh.vertices, [("tetra", mesh.tets[:, [1, 0, 2, 3]])])
    meshio.write(tmp_path / "bar.vtu", mirrored)
    with pytest.warns(MeshNotice, match=r"bar\.vtu: all"):
        (notice,) = mesh_body(tmp_path / "bar.vtu", stage=lambda *_: None).notices
    assert notice.startswith("bar.vtu: all ")


def opened(body: Body, folder: Path) -> tuple[Workspace, Mailbox]:
    mailbox = Mailbox()
    shared = SharedBody(lambda stage: body)
    settings = ServerSettings(
        title="", up="z", token="t", folder=folder, scratch=folder, body=shared
    )
    workspace = Workspace(settings, mailbox.put)
    workspace.open()
    return workspace, mailbox


def test_a_page_asks_for_it(tmp_path: Path) -> None:
    workspace, mailbox = opened(scan(tmp_path, filling=COARSE), tmp_path)
    mailbox.wait_for(Opened, kind="mesh", has_surface=True)
    begun = mailbox.messages[-1]
    assert isinstance(begun, Opened)
    (notice,) = begun.notices
    assert notice.endswith("; Check surface says more"), "the page has a button, not a command"
    workspace.receive(Check(request=3))
    mailbox.wait_for(Checked, request=3, fine=False)
    workspace.close()


def test_tets_have_no_surface_to_check(tmp_path: Path) -> None:
    body = Body(name="bar", mesh=bar_problem().mesh, file=None, folder=tmp_path)
    workspace, mailbox = opened(body, tmp_path)
    mailbox.wait_for(Opened, kind="mesh", has_surface=False)
    workspace.receive(Check(request=4))
    mailbox.wait_for(Failed, request=4)
    (refusal,) = [one for one in mailbox.messages if isinstance(one, Failed)]
    assert "came as tets" in refusal.message
    workspace.close()
