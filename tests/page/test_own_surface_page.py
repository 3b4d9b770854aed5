"""A closed surface from its file to a model that is dragged: the page shows that surface."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, export_html, load, read_surface
from snapspace.filling import SurfaceFilling
from snapspace.mesh import write_surface
from snapspace.server import SharedBody, problem_body, read_mesh

from ..server.in_process import started
from .choosing_page import BAR, compute, ends_as_handles, handles, press, tool, wait_for_text
from .frames import session_at_frame
from .pages import OpenPage, Page
from .test_posing_page import assert_shown

# Coarser than the tets, and its edges are sharp: quick tets cut them off.
FILLING = SurfaceFilling(edge_length=0.06)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("own")
    write_surface(folder / "bar.obj", BAR.vertices, BAR.surface)
    return folder


@pytest.fixture(scope="module")
def address(folder: Path) -> str:
    return started(body=SharedBody(read_mesh(folder / "bar.obj", filling=FILLING)), folder=folder)


def polished(page: Page, model: PosingModel) -> np.ndarray:
    """What a session's polish makes of the page's frame, on the user's surface."""
    session = session_at_frame(page, model)
    return model.surface.vertices(session.polish(iterations=10).vertices)


def test_it_is_chosen_on_computed_dragged_polished_and_saved(
    address: str, folder: Path, opened: OpenPage
) -> None:
    vertices, faces = read_surface(folder / "bar.obj")
    page = opened(address)
    page.wait("snapspace.kind === 'choosing'")
    shape = page.numbers("snapspace.choosing.mesh.shape").reshape(-1, 3)
    np.testing.assert_allclose(shape, vertices, atol=1e-6)
    assert np.array_equal(page.numbers("snapspace.choosing.mesh.faces"), faces.ravel())
    assert "inside" not in page.text(".hud p")
    ends_as_handles(page)
    chosen = handles(page)
    foot = vertices[sorted(chosen["foot"]), 0]
    assert foot.max() < 1.7 and len(foot) >= np.count_nonzero(vertices[:, 0] < 0.5)

    compute(page)
    page.wait("snapspace.kind === 'posing'")
    wait_for_text(page, "#panel", "Done in")
    assert page.run("snapspace.session.model.space.vertices") == len(vertices)
    np.testing.assert_allclose(page.shown(), vertices, atol=1e-5)
    owners = page.numbers("snapspace.session.model.handleOfVertex")
    for index, name in enumerate(("foot", "head")):
        assert chosen[name] == set(np.flatnonzero(owners == index).tolist()), "as painted"

    page.drag(page.run("snapspace.handle(1)"), 60, -50)
    page.wait("document.querySelector('.hud').innerText.includes('polished, moved')")
    page.rest()
    after_polish = page.shown()
    tool(page, "y up")
    press(page, "Save")
    wait_for_text(page, "#panel", f"in {folder}")
    model = load(folder / "bar.snapspace")
    assert isinstance(model, PosingModel)
    diagonal = model.problem.mesh.diagonal
    assert np.abs(after_polish - polished(page, model)).max() < 1e-4 * diagonal
    press(page, "Polish")  # off: the live shape
    page.drag(page.run("snapspace.handle(1)"), 20, 10)
    assert np.linalg.norm(page.motions()[1][1]) > 0.1
    assert_shown(model, page)
    assert_saved_shows_the_surface(folder, model, chosen, opened)


def assert_saved_shows_the_surface(
    folder: Path, model: PosingModel, chosen: dict[str, set[int]], opened: OpenPage
) -> None:
    """The saved handles in a workspace, and the saved model as a page, are on the own surface."""
    content = json.loads((folder / "bar.json").read_text(encoding="utf-8"))
    assert (content["mesh"], content["surface"]) == ("bar.msh", "bar.obj")
    vertices, _ = read_surface(folder / "bar.obj")
    body = SharedBody(lambda _: problem_body(folder / "bar.json"))
    page = opened(started(body=body, folder=folder))
    page.wait("snapspace.kind === 'choosing'")
    assert page.run("snapspace.choosing.mesh.shape.length") == vertices.size
    assert handles(page) == chosen, "as painted"
    page.page.locator("footer input[type=file]").set_input_files(folder / "bar.snapspace")
    page.wait("snapspace.kind === 'posing'")
    assert page.run("snapspace.stage.up") == "y"
    owners = page.numbers("snapspace.session.model.handleOfVertex")
    for index, name in enumerate(("foot", "head")):
        assert chosen[name] == set(np.flatnonzero(owners == index).tolist())
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    assert handles(page) == chosen, "the model remembers what was painted"
    page = opened(export_html(model, folder / "bar.html").as_uri())
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    assert len(page.shown()) == len(vertices)
    assert_shown(model, page)


def test_a_surface_that_is_dropped_on_the_page_is_saved_with_its_tets(
    tmp_path: Path, folder: Path, opened: OpenPage
) -> None:
    page = opened(started(title="Snapspace", folder=tmp_path, filling=FILLING))
    wait_for_text(page, "#message", "Drop a mesh here")
    page.page.set_input_files("#message input", folder / "bar.obj")
    page.wait("snapspace.kind === 'choosing'")
    ends_as_handles(page)
    press(page, "Save handles")
    wait_for_text(page, "#panel", "Saved bar.json, bar.msh, bar.obj")
    own, _ = read_surface(folder / "bar.obj")
    again, _ = read_surface(tmp_path / "bar.obj")
    np.testing.assert_allclose(again, own, atol=1e-8)
    assert json.loads((tmp_path / "bar.json").read_text("utf-8"))["surface"] == "bar.obj"
