"""A surface is on the screen before it has tets, and the view stays when they come."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from snapspace.filling import SurfaceFilling
from snapspace.mesh.surface import compact_surface
from snapspace.server.bodies import read_mesh
from snapspace.server.body import Body
from snapspace.server.opening import Opening
from snapspace.server.shared_body import SharedBody
from snapspace.stopping import check_stop

from ..server.held_filling import HeldFilling
from ..server.in_process import socket, started
from .choosing_page import (
    BAR,
    TAKE_HANDLES,
    cancel,
    handles,
    places,
    press,
    selected,
    stroke,
    tool,
    wait_for_text,
)
from .pages import OpenPage, Page

CAMERA = "snapspace.stage.camera.position.toArray()"
IS_LOOKED_AT = "snapspace.kind === 'surface'"
RED = "v {} {} {} 1 0 0"


def red_bar(folder: Path) -> Path:
    """A file with the surface of `BAR`."""
    file = folder / "bar.obj"
    vertices, faces = compact_surface(BAR.vertices, BAR.surface)
    lines = [RED.format(*vertex) for vertex in vertices]
    lines += [f"f {a} {b} {c}" for a, b, c in faces + 1]
    file.write_text("\n".join(lines))
    return file


def dropped(folder: Path, opened: OpenPage, filling: SurfaceFilling) -> Page:
    """A page on which the surface of `BAR`, in red, has been dropped."""
    file = red_bar(folder)
    page: Page = opened(started(filling=filling, folder=folder))
    page.page.set_input_files("#message input[type=file]", file)
    page.wait(IS_LOOKED_AT)
    return page


@pytest.fixture
def filling() -> HeldFilling:
    return HeldFilling(outcome=BAR)


def test_a_surface_is_there_before_its_tets_and_nothing_moves_when_they_come(
    tmp_path: Path, opened: OpenPage, chromium: object, filling: HeldFilling
) -> None:
    page = dropped(tmp_path, opened, filling)
    wait_for_text(page, "#message", "Making a solid of bar")
    page.wait("document.querySelector('#message progress').checkVisibility()")
    assert page.text("#message").count("Filling") == 1, "only its stage says so"
    page.wait("snapspace.scene.surface.colors === 'material'")
    page.page.reload()
    page.wait(IS_LOOKED_AT)
    wait_for_text(page, "#message", "Making a solid of bar")
    page.wait("snapspace.scene.surface.colors === 'material'")
    first = page.run(CAMERA)
    page.drag((300, 200), 80, 20)
    press(page, "Wireframe")
    page.settle()
    camera = page.run(CAMERA)
    assert camera != first
    page.run("void (window.before = snapspace.scene.surface)")
    filling.let_go.set()
    page.wait("snapspace.kind === 'choosing'")
    assert page.run("before === snapspace.choosing.surface")
    assert page.run(CAMERA) == camera
    wires = page.page.get_by_role("button", name="Wireframe")
    assert wires.get_attribute("aria-pressed") == "true"
    assert page.run("document.getElementById('message').hidden")
    assert page.run("before.colors") == "material"

    x, y = places(page).T
    tool(page, "Box")
    stroke(page, (x.min() - 5, y.min() - 5), (x.min() + 40, y.max() + 5))
    assert selected(page)
    assert page.run("before.colors") == "own", "materials would hide what is chosen"


def test_a_surface_that_cannot_be_filled_stays_with_the_reason(
    tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    filling = HeldFilling(outcome="it is too thin here; thicken it")
    page = dropped(tmp_path, opened, filling)
    filling.let_go.set()
    wait_for_text(page, "#message", "bar.obj: it is too thin here; thicken it")
    assert page.run(IS_LOOKED_AT)
    press(page, "Close")
    press(page, "Check surface")
    wait_for_text(page, ".findings", "Ready")


def test_filling_can_be_cancelled(
    tmp_path: Path, opened: OpenPage, chromium: object, filling: HeldFilling
) -> None:
    page = dropped(tmp_path, opened, filling)
    wait_for_text(page, "#message", "Making a solid of bar")
    cancel(page)
    wait_for_text(page, "#message", "Drop a mesh here")
    page.wait("snapspace.stage.root.children.length === 0")


def test_a_tab_that_was_taken_over_shows_no_filling(
    tmp_path: Path, opened: OpenPage, chromium: object, filling: HeldFilling
) -> None:
    page = dropped(tmp_path, opened, filling)
    wait_for_text(page, "#message", "Making a solid of bar")
    id = page.run("new URLSearchParams(location.search).get('workspace')")
    with socket(page.address, id):
        wait_for_text(page, "#connection", "open in another tab")
        assert page.run("document.getElementById('message').hidden"), "it could not cancel it"
        assert page.run(IS_LOOKED_AT)
    press(page, "Use it here")
    wait_for_text(page, "#message", "Making a solid of bar")
    filling.let_go.set()
    page.wait("snapspace.kind === 'choosing'")


def test_the_state_of_reading_is_shown_once(opened: OpenPage, chromium: object) -> None:
    def read(opening: Opening) -> Body:
        opening.stage("reading")
        while True:  # until the page is closed
            check_stop()
            time.sleep(0.01)

    page: Page = opened(started(body=SharedBody(read)))
    wait_for_text(page, "#message", "Reading the mesh")
    text = page.text("#message")
    assert text.startswith("Opening bar") and text.count("Reading the mesh") == 1


class MadeAnew(SharedBody):
    """Makes its body for every workspace."""

    def get(self, opening: Opening) -> Body:
        return self._make(opening)


#: The next connection asks for a new workspace, as if the server had been started again.
FORGETFUL = """(() => {
  window.WebSocket = class extends WebSocket {
    constructor(address) {
      address.searchParams.delete("workspace");
      super(address);
    }
  };
})()"""


def test_what_was_chosen_is_sent_to_a_server_that_fills_the_surface_again(
    tmp_path: Path, opened: OpenPage, chromium: object, filling: HeldFilling
) -> None:
    filling.let_go.set()
    address = started(body=MadeAnew(read_mesh(red_bar(tmp_path), filling=filling)))
    page: Page = opened(address)
    page.wait("snapspace.kind === 'choosing'")
    page.run(TAKE_HANDLES, [["foot", [0, 1, 2]], ["head", [5, 6, 7]]])
    chosen = handles(page)
    workspace = "new URLSearchParams(location.search).get('workspace')"
    before = page.run(workspace)
    page.run(FORGETFUL)
    sent: list[str] = []
    page.page.on("websocket", lambda to: to.on("framesent", lambda text: sent.append(text)))
    with socket(address, before):
        wait_for_text(page, "#connection", "open in another tab")
        press(page, "Use it here")
        page.wait(f"{workspace} !== {before!r}")
        page.wait_for(lambda: any("head" in text for text in sent), "the choice is sent")
    assert handles(page) == chosen
